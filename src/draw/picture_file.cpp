#include "draw/picture_file.h"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <numbers>
#include <span>

#include "cli/exit_status.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/tell.h"
#include "draw/dxf.h"
#include "files/extension.h"
#include "files/mark.h"
#include "roam/error.h"

namespace roam::draw {
namespace {

struct Free {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};
using Context = std::unique_ptr<cairo_t, Free>;
using Surface = std::unique_ptr<cairo_surface_t, Free>;

/// Keeps letters as wide in a PNG as in an SVG: not fitted to pixels.
void prepare(cairo_t* context) {
  const std::unique_ptr<cairo_font_options_t, Free> options(cairo_font_options_create());
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(context, options.get());
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
}

void choose(cairo_t* context, const Font& font) {
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, font.size);
}

void set_colour(cairo_t* context, const Colour& c) { cairo_set_source_rgba(context, c.red, c.green, c.blue, c.alpha); }

/// Fills and strokes the current path.
void paint(cairo_t* context, const Style& style) {
  if (style.fill) {
    set_colour(context, *style.fill);
    cairo_fill_preserve(context);
  }
  if (style.width > 0.0) {
    set_colour(context, style.stroke);
    const auto dashes = std::find(style.dash.begin(), style.dash.end(), 0.0) - style.dash.begin();
    cairo_set_dash(context, style.dash.data(), static_cast<int>(dashes), 0.0);
    cairo_set_line_width(context, style.width);
    cairo_stroke_preserve(context);
  }
  cairo_new_path(context);
}

void begin_clip(cairo_t* context, const Rect& clip) {
  cairo_save(context);
  if (clip.empty()) return;
  cairo_rectangle(context, clip.lower.x, clip.lower.y, clip.width(), clip.height());
  cairo_clip(context);
}

void draw(cairo_t* context, const Lines& shape) {
  begin_clip(context, shape.clip);
  for (const Polyline& line : shape.lines) {
    cairo_new_sub_path(context);
    for (const Point& p : line) cairo_line_to(context, p.x, p.y);
    if (shape.closed) cairo_close_path(context);
  }
  paint(context, shape.style);
  cairo_restore(context);
}

void draw(cairo_t* context, const Disc& disc) {
  begin_clip(context, disc.clip);
  cairo_arc(context, disc.centre.x, disc.centre.y, disc.radius, 0.0, 2.0 * std::numbers::pi);
  paint(context, disc.style);
  cairo_restore(context);
}

void draw(cairo_t* context, const Text& text) {
  choose(context, text.font);
  set_colour(context, text.colour);
  cairo_move_to(context, text.at.x, text.at.y);
  cairo_show_text(context, text.text.c_str());
  cairo_new_path(context);
}

/// Returns the first error of the drawing, which the surface does not know.
cairo_status_t draw(cairo_surface_t* surface, const Sheet& sheet) {
  const Context context(cairo_create(surface));
  prepare(context.get());
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
  cairo_paint(context.get());
  for (const auto& item : sheet.items) std::visit([&](const auto& shape) { draw(context.get(), shape); }, item);
  cairo_show_page(context.get());
  return cairo_status(context.get());
}

const std::filesystem::path& checked(const std::filesystem::path& file, PictureFile::Views views) {
  const std::string extension = files::lower_extension(file);
  const bool in_metres = views == PictureFile::Views::in_metres;
  if (extension == ".svg" || extension == ".png" || (extension == ".dxf" && in_metres)) {
    const app::NamedFile picture{"--picture", file, files::marked("picture")};
    app::demand_no_overwriting({}, {&picture, 1});
    return file;
  }
  throw app::UsageError("--picture " + file.string(), in_metres
                                                          ? "a picture is an .svg, a .png or a .dxf, by its extension"
                                                          : "a picture is an .svg or a .png, by its extension");
}

/// Appends to a std::string. Cairo is C, so no exception may pass through it.
cairo_status_t append(void* text, const unsigned char* bytes, unsigned int size) noexcept {
  try {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), size);
    return CAIRO_STATUS_SUCCESS;
  } catch (const std::exception&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

}  // namespace

Rect measure_text(const std::string& text, const Font& font) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const Context context(cairo_create(surface.get()));
  prepare(context.get());
  choose(context.get(), font);
  cairo_text_extents_t extents;
  cairo_text_extents(context.get(), text.c_str(), &extents);
  cairo_font_extents_t line;
  cairo_font_extents(context.get(), &line);
  return {{std::min(0.0, extents.x_bearing), -line.ascent},
          {std::max(extents.x_advance, extents.x_bearing + extents.width), line.descent}};
}

PictureFile::PictureFile(const std::filesystem::path& file, Views views)
    : path_(checked(file, views)), file_(file, files::Naming::exact, files::marked("picture")) {}

void PictureFile::write(const Sheet& sheet) {
  std::string bytes;
  cairo_status_t status = CAIRO_STATUS_SUCCESS;
  const std::string extension = files::lower_extension(path_);
  if (extension == ".dxf") {
    bytes = to_dxf(sheet);
  } else if (extension == ".svg") {
    const Surface surface(cairo_svg_surface_create_for_stream(append, &bytes, sheet.width, sheet.height));
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
    status = draw::draw(surface.get(), sheet);
    cairo_surface_finish(surface.get());
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
  } else {
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(sheet.width)),
                                                     static_cast<int>(std::lround(sheet.height))));
    status = draw::draw(surface.get(), sheet);
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    throw Error(fmt::format("cannot draw the picture {}: {}", path_.string(), cairo_status_to_string(status)));
  }
  files::add_mark(bytes);
  file_.write(std::as_bytes(std::span(bytes)));
  file_.commit();
}

void PictureFile::draw(const std::function<Sheet()>& make) {
  app::give_time_to_write(app::longest_drawing);
  Sheet sheet;
  if (!app::finishes(path_.string() + " was not drawn", [&] { sheet = make(); })) return;
  write(sheet);
  const CoarseLines& c = sheet.coarsest;
  if (c.pixels > 0.0) {
    app::tell(fmt::format("note: too many lines in the picture: the coarsest ({}) are rounded to {:.3g} m{}", c.what,
                          c.metres, c.left_out > 0 ? fmt::format(", and the {} shortest left out", c.left_out) : ""));
  }
  if (sheet.runs_left_out > 0) {
    app::tell(fmt::format("note: too many jumps for the picture: {} parts of the way between them are left out",
                          sheet.runs_left_out));
  }
}

}  // namespace roam::draw
