#include "server/command/scene_source.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

#include "sim/scene/value.h"
#include "sim/shape/mesh_file.h"

namespace lather::server {

std::string read_text(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file))
    throw InputError(
        {{"", file.string(), "a readable file", "cannot read " + file.string() + ": it is a directory"}});
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

MeshSource meshes_beside(const std::filesystem::path& scene_file) {
  return [directory = scene_file.parent_path()](const std::string& file) {
    const std::filesystem::path path = file;
    const bool leaves = std::find(path.begin(), path.end(), "..") != path.end();
    if (path.is_absolute() || leaves)
      throw MeshError("A mesh must lie in the directory of the scene's file, or below it. Put it there.",
                      "a relative path without \"..\"");
    std::ifstream stream(directory / path, std::ios::binary);
    std::string bytes(kMaxMeshBytes + 1, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    if (bytes.empty())
      throw MeshError("There is no readable file " + (directory / path).string() + ", or it is empty.",
                      "a file in the directory of the scene's file, or below it");
    return bytes;
  };
}

Scene read_scene(const SceneSource& source) {
  return parse_scene(read_text(source.file), source.size, read_overrides(source.set),
                     meshes_beside(source.file));
}

Scene scene_of(const ScenesOptions& options, const std::filesystem::path& file) {
  const Value document = parse_json(read_text(file));
  const bool sized = at_pointer(document, "/sizes" + pointer_token(options.size)) != nullptr;
  return read_scene({file, sized ? options.size : "", options.set});
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
