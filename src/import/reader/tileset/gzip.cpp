#include "import/reader/tileset/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

#include "roam/error.h"

namespace roam::reader {

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::string without_gzip(std::string bytes, const std::string& place) {
  if (!is_gzip(bytes)) return bytes;
  z_stream stream{};
  constexpr int gzip_only = 16;
  if (inflateInit2(&stream, MAX_WBITS + gzip_only) != Z_OK) throw std::bad_alloc();
  struct End {
    z_stream& stream;
    ~End() { inflateEnd(&stream); }
  } const end{stream};
  constexpr std::size_t step = 1u << 20;
  std::string content;
  std::size_t taken = 0;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    const std::size_t held = content.size();
    const auto more = std::min<std::size_t>(bytes.size() - taken, std::numeric_limits<uInt>::max());
    content.resize(held + step);
    stream.next_in = reinterpret_cast<Bytef*>(bytes.data() + taken);
    stream.avail_in = static_cast<uInt>(more);
    stream.next_out = reinterpret_cast<Bytef*>(content.data() + held);
    stream.avail_out = static_cast<uInt>(step);
    state = inflate(&stream, Z_NO_FLUSH);
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    taken += more - stream.avail_in;
    content.resize(held + step - stream.avail_out);
    const bool stuck = state == Z_OK && content.size() == held && stream.avail_in == more;
    if ((state != Z_OK && state != Z_STREAM_END) || stuck) {
      throw Error(place, "its gzip compression is damaged; copy or export it again.");
    }
  }
  return content;
}

}  // namespace roam::reader
