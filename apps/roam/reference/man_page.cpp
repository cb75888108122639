#include "reference/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace roam::app {
namespace {

/// Characters that troff would change or take for its own. Dashes of `code` can be copied into a shell.
std::string escaped(std::string_view text, bool code) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '\\':
        out += "\\e";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '`':
        out += "\\(ga";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      case '-':
        out += code ? "\\-" : "-";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string bold(std::string_view text) { return text.empty() ? "" : "\\fB" + escaped(text, true) + "\\fP"; }

std::string italic(std::string_view text) { return text.empty() ? "" : "\\fI" + escaped(text, true) + "\\fP"; }

/// A line of prose: `code` and --options are bold, and no line begins with a request of troff.
std::string prose(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const bool begins_word = at == 0 || text[at - 1] == ' ' || text[at - 1] == '(';
    if (const std::size_t end = text.find('`', at + 1); text[at] == '`' && end != std::string_view::npos) {
      out += bold(text.substr(at + 1, end - at - 1));
      at = end + 1;
    } else if (begins_word && text[at] == '-' && at + 1 < text.size() && text[at + 1] != ' ') {
      const auto is_name = [](char c) { return c == '-' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
      const auto* last = std::find_if_not(text.begin() + at, text.end(), is_name);
      const std::string_view name(text.begin() + at, last);
      out += bold(name);
      at += name.size();
    } else {
      out += escaped(text.substr(at, 1), false);
      ++at;
    }
  }
  return out.starts_with('.') ? "\\&" + out : out;
}

/// SCENE..., [OPTIONS], --from X,Y,Z
std::string synopsis(std::string_view usage) {
  std::string out;
  while (!usage.empty()) {
    const std::string_view word = usage.substr(0, usage.find(' '));
    usage.remove_prefix(std::min(word.size() + 1, usage.size()));
    const std::size_t begin = word.starts_with('[') ? 1 : 0;
    const std::size_t end = std::min(word.find_first_of("].", begin), word.size());
    const std::string_view name = word.substr(begin, end - begin);
    if (!out.empty()) out += ' ';
    out += word.substr(0, begin);
    out += name.starts_with('-') ? bold(name) : italic(name);
    out += word.substr(end);
  }
  return out;
}

std::string heading(const char* macro, const std::string& title) {
  return fmt::format(".{} \"{}\"\n", macro, escaped(title, false));
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string entry_text(const HelpEntry& entry) {
  std::string names;
  const bool is_argument = !entry.is_option() && entry.names.front() == upper(entry.names.front());
  for (const std::string& name : entry.names) {
    if (!names.empty()) names += ", ";
    names += is_argument ? italic(name) : bold(name);
  }
  if (!entry.value.empty()) names += ' ' + italic(entry.value);
  if (entry.many) names += "...";
  return fmt::format(".TP\n{}\n{}\n", names, prose(entry.description));
}

/// The footer: paragraphs, lines that stay as they are, and examples under a heading of their own.
std::string footer_text(std::string_view footer) {
  std::string text;
  bool paragraph = false, verbatim = false;
  const auto end_verbatim = [&] {
    if (verbatim) text += ".EE\n";
    verbatim = false;
  };
  while (!footer.empty()) {
    const std::string_view line = footer.substr(0, footer.find('\n'));
    footer.remove_prefix(std::min(line.size() + 1, footer.size()));
    if (line.empty()) {
      end_verbatim();
      paragraph = false;
    } else if (line == "Examples:") {
      end_verbatim();
      text += ".SH EXAMPLES\n";
      paragraph = true;
    } else if (line.front() == ' ') {
      if (!verbatim) text += ".EX\n";
      verbatim = true;
      paragraph = false;
      text += "  " + escaped(line.substr(line.find_first_not_of(' ')), true) + "\n";
    } else {
      end_verbatim();
      if (!paragraph) text += ".PP\n";
      paragraph = true;
      text += prose(line) + "\n";
    }
  }
  end_verbatim();
  return text;
}

/// "send a body along a path", for the list of all pages.
std::string short_description(const HelpPage& page) {
  std::string text = page.description;
  const std::string own = page.name + ": ";
  if (text.starts_with(own)) text.erase(0, own.size());
  if (text.ends_with('.')) text.pop_back();
  text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  return text;
}

std::string reference_to(const HelpPage& page) { return fmt::format("{}(1)", bold(man_page_name(page))); }

std::string see_also(const HelpPage& page, const HelpPage& program) {
  std::vector<std::string> pages;
  if (&page != &program) pages.push_back(reference_to(program));
  for (const HelpPage& verb : program.below) {
    const bool above = page.name.starts_with(verb.name + " ");
    if (above || (&page == &program)) pages.push_back(reference_to(verb));
  }
  if (&page != &program) {
    for (const HelpPage& kind : page.below) pages.push_back(reference_to(kind));
  }
  return fmt::format(".SH \"SEE ALSO\"\n{}\n", fmt::join(pages, ",\n"));
}

}  // namespace

std::string man_page_name(const HelpPage& page) {
  std::string name = page.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string man_page(const HelpPage& page, const HelpPage& program, const std::string& version,
                     const std::string& date) {
  const std::string name = man_page_name(page);
  std::string text = fmt::format(".\\\" The help of {} {}, which wrote this page.\n", program.name, version);
  text += fmt::format(".TH {} 1 {} \"{} {}\"\n", escaped(upper(name), true), date, program.name, version);
  text += fmt::format(".SH NAME\n{} \\- {}\n", escaped(name, true), escaped(short_description(page), false));
  text += fmt::format(".SH SYNOPSIS\n{} {}\n", bold(page.name), synopsis(page.usage));
  const std::size_t examples = std::min(page.footer.find("Examples:\n"), page.footer.size());
  const std::string details = footer_text(std::string_view(page.footer).substr(0, examples));
  // .PP directly after a heading has no effect.
  if (!details.empty()) text += ".SH DESCRIPTION\n" + details.substr(details.starts_with(".PP\n") ? 4 : 0);
  bool options = false;
  for (const HelpSection& section : page.sections) {
    const bool of_options = section.entries.front().is_option();
    if (of_options && !options) text += heading("SH", "OPTIONS");
    options |= of_options;
    const std::string title = section.title.empty() ? "Arguments" : section.title;
    if (!of_options) text += heading("SH", upper(title));
    if (of_options && title != "Options") text += heading("SS", title);
    for (const HelpEntry& entry : section.entries) text += entry_text(entry);
  }
  return text + footer_text(std::string_view(page.footer).substr(examples)) + see_also(page, program);
}

}  // namespace roam::app
