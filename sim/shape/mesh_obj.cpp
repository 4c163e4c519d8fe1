#include <charconv>
#include <cmath>

#include "sim/shape/mesh_file.h"

/// Wavefront OBJ: the lines "v x y z" and "f i j k …", where a corner may be i, i/t, i//n or i/t/n and a
/// negative i counts back from the last position. All other lines say nothing about the shape.
namespace lather {
namespace {

constexpr const char* kAllowed = "lines \"v x y z\" and \"f i j k ...\" of a Wavefront OBJ";

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& file) : rest_(text), file_(file) {
    mesh_.face_word = "line";
  }

  MeshData read() {
    while (!rest_.empty()) {
      ++line_;
      const std::size_t end = rest_.find('\n');
      words_ = rest_.substr(0, end);
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      const std::string_view kind = next_word();
      if (kind == "v") read_position();
      if (kind == "f") read_face();
    }
    check_indices();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { refuse_at(line_, what); }
  [[noreturn]] void refuse_at(std::uint32_t line, const std::string& what) const {
    throw MeshError(file_ + ", line " + std::to_string(line) + ": " + what, kAllowed);
  }

  std::string_view next_word() {
    const std::size_t start = words_.find_first_not_of(" \t\r");
    if (start == std::string_view::npos) return {};
    words_.remove_prefix(start);
    const std::string_view word = words_.substr(0, words_.find_first_of(" \t\r"));
    words_.remove_prefix(word.size());
    return word;
  }

  void read_position() {
    std::array<float, 3> position{};
    for (float& x : position) {
      const std::string_view word = next_word();
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      x = static_cast<float>(value);
      if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(x))
        refuse("a position needs three finite numbers, and \"" + std::string(word) +
               "\" is none. Export the mesh again.");
    }
    mesh_.positions.push_back(position);
  }

  /// The index of a corner from 0; forward references are checked once all positions are known.
  std::uint32_t corner(std::string_view word) const {
    const std::string_view index = word.substr(0, word.find('/'));
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(index.data(), index.data() + index.size(), value);
    if (error != std::errc{} || end != index.data() + index.size() || value == 0)
      refuse("\"" + std::string(word) + "\" is no corner of a face; positions are counted from 1.");
    const auto count = static_cast<std::int64_t>(mesh_.positions.size());
    const std::int64_t from_zero = value > 0 ? value - 1 : count + value;
    if (from_zero < 0 || from_zero >= 0xFFFFFFFF)
      refuse("the face asks for position " + std::to_string(value) + ", and there are " +
             std::to_string(count) + " before it. Export the mesh again.");
    return static_cast<std::uint32_t>(from_zero);
  }

  void read_face() {
    std::array<std::uint32_t, 2> fan{};
    std::size_t corners = 0;
    for (std::string_view word = next_word(); !word.empty(); word = next_word(), ++corners) {
      const std::uint32_t index = corner(word);
      if (corners >= 2) {
        mesh_.triangles.push_back({fan[0], fan[1], index});
        mesh_.face.push_back(line_);
      }
      fan[corners == 0 ? 0 : 1] = index;
    }
    if (corners < 3) refuse("a face needs three corners at least.");
  }

  void check_indices() const {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::uint32_t i : mesh_.triangles[t])
        if (i >= mesh_.positions.size())
          refuse_at(mesh_.face[t], "the face asks for position " + std::to_string(i + std::uint64_t{1}) +
                                       ", and the file has " + std::to_string(mesh_.positions.size()) +
                                       ". Export the mesh again.");
  }

  std::string_view rest_, words_;
  const std::string& file_;
  std::uint32_t line_ = 0;
  MeshData mesh_;
};

}  // namespace

MeshData read_obj(std::string_view bytes, const std::string& file) {
  return ObjReader(bytes, file).read();
}

}  // namespace lather
