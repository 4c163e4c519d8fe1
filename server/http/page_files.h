#pragma once

#include <cstddef>
#include <vector>

namespace lather::server {

struct PageFile {
  const char* name;
  const unsigned char* bytes;
  std::size_t size;
};

/// The files of web/dist/; the source is made at build time (embed.cmake).
[[nodiscard]] const std::vector<PageFile>& page_files();

}  // namespace lather::server
