#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "sim/report/report.h"

/// What the checkpoints of both solvers are written with: plain values in the machine's own order.
namespace lather::checkpoint {

/// Throws InputError: the bytes are no checkpoint of this run.
[[noreturn]] void refuse(const std::string& why);

class Writer {
 public:
  /// Magic and `key`, which names scene, level and build.
  explicit Writer(const std::string& key);

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put_text(const std::string& text);
  void put_numbers(const std::vector<double>& numbers);
  /// What the report has gathered so far.
  void put_report(const Report& report);

  std::string bytes;
};

class Reader {
 public:
  /// Refuses bytes with another key.
  Reader(const std::string& bytes, const std::string& key);

  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (static_cast<std::size_t>(end_ - at_) < sizeof value) refuse("The checkpoint ends too early.");
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
  }
  [[nodiscard]] std::string get_text();
  void get_numbers(std::vector<double>& numbers);
  /// Into the report of the same plan.
  void get_report(Report& report);
  /// The points of all sets, which are the last thing in a checkpoint.
  template <class Sets>
  void get_sets(Sets& sets) {
    try {
      for (auto& set : sets) set.restore(at_, end_);
    } catch (const std::runtime_error& e) {
      refuse(e.what());
    }
    if (at_ != end_) refuse("The checkpoint is longer than its state.");
  }

 private:
  const char* at_;
  const char* end_;
};

}  // namespace lather::checkpoint
