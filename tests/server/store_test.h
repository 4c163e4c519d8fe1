#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "server/store/store.h"
#include "tests/server/temporary_directory.h"

namespace lather::server {

/// Where the tests of one database get their stores.
class StorePlace {
 public:
  virtual ~StorePlace() = default;
  virtual std::unique_ptr<Store> open() = 0;  ///< the same database each time
};

struct StoreKind {
  const char* name;
  std::unique_ptr<StorePlace> (*new_place)();  ///< fresh and empty
};
inline void PrintTo(const StoreKind& kind, std::ostream* out) {
  *out << kind.name;
}

/// What every store promises, whatever its database.
class StoreTest : public ::testing::TestWithParam<StoreKind> {
 protected:
  StoreTest() : place_(GetParam().new_place()), store_(place_->open()) {}

  std::string add(const std::string& name, int priority = 0, const std::string& key = {});
  void reopen() {
    store_.reset();
    store_ = place_->open();
  }

  std::unique_ptr<StorePlace> place_;
  std::unique_ptr<Store> store_;
};

[[nodiscard]] Submission sample_submission(const std::string& name);

}  // namespace lather::server
