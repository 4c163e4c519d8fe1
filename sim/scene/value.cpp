#include "sim/scene/value.h"

#include <algorithm>
#include <charconv>

namespace lather {
namespace {

[[noreturn]] void refuse(std::string_view pointer, const std::string& allowed, const std::string& message) {
  throw InputError({{std::string(pointer), "", allowed, message}});
}

/// The keys of a pointer, unescaped.
std::vector<std::string> tokens_of(std::string_view pointer) {
  std::vector<std::string> tokens;
  if (pointer.empty()) return tokens;
  if (pointer.front() != '/') {
    refuse(pointer, "a JSON pointer such as /numerics/time_step", "A JSON pointer starts with \"/\".");
  }
  for (const char c : pointer) {
    if (c == '/') {
      tokens.emplace_back();
    } else {
      tokens.back() += c;
    }
  }
  for (std::string& token : tokens) {
    for (std::size_t i = token.find('~'); i != std::string::npos; i = token.find('~', i + 1)) {
      const char next = i + 1 < token.size() ? token[i + 1] : ' ';
      if (next != '0' && next != '1')
        refuse(pointer, "~0 for ~ and ~1 for /", "A \"~\" in a JSON pointer is an escape.");
      token.replace(i, 2, next == '0' ? "~" : "/");
    }
  }
  if (tokens.size() > kMaxJsonDepth)
    refuse(pointer, "at most 32 levels", "The pointer is nested too deeply.");
  return tokens;
}

/// The element that `token` names; null where it is no index of the array.
template <class A>
auto* element(A& array, const std::string& token) {
  std::size_t index = 0;
  const char* end = token.data() + token.size();
  const auto read = std::from_chars(token.data(), end, index);
  const bool canonical = token == "0" || (!token.empty() && token.front() != '0');
  const bool found = read.ec == std::errc() && read.ptr == end && canonical && index < array.size();
  return found ? &array[index] : nullptr;
}

}  // namespace

const Value* Value::find(std::string_view key) const {
  const Object* members = object();
  if (members == nullptr) return nullptr;
  const auto found =
      std::find_if(members->begin(), members->end(), [&](const auto& m) { return m.first == key; });
  return found == members->end() ? nullptr : &found->second;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(
      static_cast<const Value*>(this)->find(key));  // NOLINT: the object itself is not const
}

void merge_patch(Value& target, const Value& patch) {
  const Object* changes = patch.object();
  if (changes == nullptr) {
    target = patch;
    return;
  }
  if (target.object() == nullptr) target = Object{};
  for (const auto& [key, change] : *changes) {
    Object& members = *target.object();
    if (std::holds_alternative<std::nullptr_t>(change.data)) {
      const std::string& gone = key;
      members.erase(
          std::remove_if(members.begin(), members.end(), [&](const auto& m) { return m.first == gone; }),
          members.end());
      continue;
    }
    if (target.find(key) == nullptr) members.emplace_back(key, Value());
    merge_patch(*target.find(key), change);
  }
}

const Value* at_pointer(const Value& root, std::string_view pointer) {
  const Value* at = &root;
  for (const std::string& token : tokens_of(pointer)) {
    at = at->array() != nullptr ? element(*at->array(), token) : at->find(token);
    if (at == nullptr) return nullptr;
  }
  return at;
}

void set_at_pointer(Value& root, std::string_view pointer, Value value) {
  const std::vector<std::string> tokens = tokens_of(pointer);
  Value* at = &root;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (Array* array = at->array()) {
      at = element(*array, tokens[i]);
      if (at == nullptr) {
        refuse(pointer, "an index below " + std::to_string(array->size()),
               "The array has no element \"" + tokens[i] + "\".");
      }
      continue;
    }
    if (at->object() == nullptr) {
      refuse(pointer, "a path through objects and arrays",
             "\"" + tokens[i] + "\" is asked of a value that has no members.");
    }
    const bool take_away = i + 1 == tokens.size() && std::holds_alternative<std::nullptr_t>(value.data);
    if (take_away) {
      merge_patch(*at, Object{{tokens[i], nullptr}});
      return;
    }
    if (at->find(tokens[i]) == nullptr) at->object()->emplace_back(tokens[i], Object{});
    at = at->find(tokens[i]);
  }
  *at = std::move(value);
}

std::string pointer_token(std::string_view key) {
  std::string token = "/";
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

}  // namespace lather
