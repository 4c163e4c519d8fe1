#include "server/command/scene_source.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

namespace lather::server {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw InputError({{"", file.string(), "a readable file",
                       "cannot read " + file.string() + ": " + std::strerror(errno)}});
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad())
    throw InputError({{"", file.string(), "a readable file", "cannot read " + file.string()}});
  return text;
}

std::vector<Override> read_overrides(const std::vector<std::string>& set) {
  std::vector<Override> overrides;
  for (const std::string& text : set) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw InputError(
          {{"", text, "/json/pointer=value", "--set needs a pointer and a value with '=' between"}});
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

Scene read_scene(const SceneSource& source) {
  return parse_scene(read_text(source.file), source.size, read_overrides(source.set));
}

void print_problems(const std::string& what, const std::vector<Problem>& problems) {
  std::fprintf(stderr, "%s\n", what.c_str());
  for (const Problem& problem : problems) {
    const std::string place = problem.pointer.empty() ? "" : problem.pointer + ": ";
    std::fprintf(stderr, "  %s%s\n", place.c_str(), problem.message.c_str());
    if (!problem.value.empty()) std::fprintf(stderr, "    found:   %s\n", problem.value.c_str());
    if (!problem.allowed.empty()) std::fprintf(stderr, "    allowed: %s\n", problem.allowed.c_str());
  }
}

}  // namespace lather::server
