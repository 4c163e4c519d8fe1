#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
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

/// What every store promises; each database runs it through a maker of fresh, empty places.
class StoreTest : public ::testing::TestWithParam<std::function<std::unique_ptr<StorePlace>()>> {
 protected:
  StoreTest() : place_(GetParam()()), store_(place_->open()) {}

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
