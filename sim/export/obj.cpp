#include <charconv>

#include "sim/export/frame_files.h"

namespace lather {
namespace {

/// The shortest text that reads back as the same number.
void put(std::string& text, float value) {
  char word[32];
  const auto end = std::to_chars(word, word + sizeof word, value).ptr;
  text += ' ';
  text.append(word, end);
}

void put_vectors(std::string& text, const char* key, const std::vector<std::array<float, 3>>& vectors) {
  for (const auto& v : vectors) {
    text += key;
    for (const float x : v) put(text, x);
    text += '\n';
  }
}

/// An object's name is one word in many programs.
std::string one_word(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  return name;
}

}  // namespace

std::string skin_obj(const Frame& frame) {
  std::string text = "# lather frame " + std::to_string(frame.index) + "\n";
  std::size_t first = 1;
  for (const FrameSkin& skin : frame.skins) {
    text += "o " + one_word(frame.material_names[skin.material]) + "\n";
    put_vectors(text, "v", skin.mesh->positions);
    put_vectors(text, "vn", skin.mesh->normals);
    for (const auto& t : skin.mesh->triangles) {
      text += 'f';
      for (const std::uint32_t i : t) {
        const std::string corner = std::to_string(first + i);
        text += ' ';
        text += corner;
        text += "//";
        text += corner;
      }
      text += '\n';
    }
    first += skin.mesh->positions.size();
  }
  return text;
}

}  // namespace lather
