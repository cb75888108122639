#pragma once
/// \file
/// Open files as streams, read piece by piece.

#include <array>
#include <filesystem>
#include <istream>
#include <streambuf>
#include <utility>

#include "files/descriptor.h"
#include "files/file_error.h"

namespace roam::files {

/// The rest of an open file or a pipe. The path is for messages. Throws FileError if reading fails.
class ReadStream : private std::streambuf, public std::istream {
 public:
  ReadStream(int file, std::filesystem::path path) : std::istream(this), file_(file), path_(std::move(path)) {
    exceptions(std::ios::badbit);  // lets errors through
  }

 private:
  std::streambuf::int_type underflow() override {
    const ssize_t got = again([&] { return ::read(file_, piece_.data(), piece_.size()); });
    if (got < 0) files::fail("read", path_, errno);
    setg(piece_.data(), piece_.data(), piece_.data() + got);
    using Traits = std::streambuf::traits_type;
    return got == 0 ? Traits::eof() : Traits::to_int_type(piece_[0]);
  }

  int file_;
  std::filesystem::path path_;
  std::array<char, 65536> piece_;
};

}  // namespace roam::files
