#include "words/measures.h"

#include <cmath>

#include "text/printable.h"

namespace roam::words {

std::string grouped(std::uint64_t number) {
  if (number < 1000) return fmt::format("{}", number);
  return grouped(number / 1000) + fmt::format(",{:03}", number % 1000);
}

namespace {

double down_to(double length, double parts_a_metre) {
  const double nearest = std::round(parts_a_metre * length);
  return (nearest / parts_a_metre <= length ? nearest : nearest - 1.0) / parts_a_metre;
}

}  // namespace

double down_to_mm(double length) { return down_to(length, 1e3); }

double up_to_mm(double length) { return -down_to_mm(-length); }

std::string metres_down(double length) { return metres(length >= 0.01 ? down_to_mm(length) : down_to(length, 1e4)); }

std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

std::string times(std::uint64_t count) {
  return count == 1 ? "once" : count == 2 ? "twice" : fmt::format("{} times", grouped(count));
}

std::string spare_words(double spare) {
  if (spare < 5e-4) return "nothing to spare";
  if (spare < 0.1) return fmt::format("{:.0f} mm to spare on each side", 1e3 * spare);
  return fmt::format("{:.2f} m to spare on each side", spare);
}

std::string size_of(double radius, double height) {
  if (height <= 2.0 * radius) return fmt::format("{:.2f} m wide (a sphere)", 2.0 * radius);
  return fmt::format("{:.2f} m wide and {:.2f} m high", 2.0 * radius, height);
}

std::string quoted(const std::string& object) {
  return object.empty() ? "an object without a name" : fmt::format("\"{}\"", printable(object));
}

std::string between(const std::string& left, const std::string& right) {
  if (left == right) return left.empty() ? std::string() : "of " + quoted(left);
  if (left.empty() || right.empty()) return "beside " + quoted(left.empty() ? right : left);
  return "between " + quoted(left) + " and " + quoted(right);
}

}  // namespace roam::words
