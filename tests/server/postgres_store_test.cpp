#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/eventually.h"
#include "tests/server/postgres_cluster.h"
#include "tests/server/store_test.h"

namespace lather::server {
namespace {

constexpr auto kShortTerm = std::chrono::milliseconds(50);

/// One for all tests of this process.
PostgresCluster& cluster() {
  static PostgresCluster one;
  return one;
}

class PostgresPlace final : public StorePlace {
 public:
  std::unique_ptr<Store> open() override { return open_postgres_store(uri_); }

 private:
  const std::string uri_ = cluster().new_database();
};

std::unique_ptr<StorePlace> new_postgres_place() {
  return std::make_unique<PostgresPlace>();
}

INSTANTIATE_TEST_SUITE_P(Postgres, StoreTest, ::testing::Values(StoreKind{"Postgres", new_postgres_place}));

/// A database with agents that lose their jobs quickly and others that do not.
class PostgresLease : public ::testing::Test {
 protected:
  PostgresLease() : uri_(cluster().new_database()) {
    PostgresSettings settings;
    hasty_ = open_postgres_store(uri_, {kShortTerm, settings.patience});
    calm_ = open_postgres_store(uri_, {std::chrono::minutes(10), settings.patience});
  }
  std::string add(const std::string& name = "foam", const std::string& key = {}) {
    Submission submission = sample_submission(name);
    submission.job.idempotency_key = key;
    const std::optional<Job> earlier = calm_->add(submission);
    return earlier ? earlier->id : submission.job.id;
  }
  bool becomes(const std::string& id, JobState wanted) {
    return eventually([&] {
      calm_->reclaim();
      return calm_->find(id)->state == wanted;
    });
  }

  const std::string uri_;
  std::unique_ptr<Store> hasty_;
  std::unique_ptr<Store> calm_;
};

TEST_F(PostgresLease, ThatIsNotRenewedGoesToAnotherAgentAsANewAttempt) {
  const std::string id = add();
  ASSERT_TRUE(hasty_->lease());
  std::optional<Job> taken;
  ASSERT_TRUE(eventually([&] { return (taken = calm_->lease()).has_value(); }));
  EXPECT_EQ(taken->id, id);
  EXPECT_EQ(taken->attempt, 2);
  EXPECT_FALSE(hasty_->heartbeat(id, 1));
  EXPECT_FALSE(hasty_->publish(id, 1, {0, "late", 10, 1}));
  EXPECT_FALSE(hasty_->settle(id, 1, JobState::kSucceeded));
  EXPECT_TRUE(calm_->publish(id, 2, {0, "in time", 10, 2}));
  EXPECT_TRUE(calm_->settle(id, 2, JobState::kSucceeded));
}

TEST_F(PostgresLease, ThatIsRenewedStays) {
  const std::string id = add();
  ASSERT_TRUE(hasty_->lease());
  ASSERT_TRUE(calm_->heartbeat(id, 1)) << "now it lasts ten minutes";
  const auto past_the_short_term = std::chrono::steady_clock::now() + 4 * kShortTerm;
  while (std::chrono::steady_clock::now() < past_the_short_term) ASSERT_FALSE(calm_->lease());
  EXPECT_EQ(calm_->reclaim(), 0u);
  EXPECT_EQ(calm_->find(id)->state, JobState::kRunning);
}

TEST_F(PostgresLease, ThatIsLostWhileCancellingCancelsTheJob) {
  const std::string id = add();
  ASSERT_TRUE(hasty_->lease());
  ASSERT_TRUE(calm_->move(id, JobState::kCancelling));
  ASSERT_TRUE(becomes(id, JobState::kCancelled));
  EXPECT_GT(calm_->find(id)->ended, 0);
}

TEST_F(PostgresLease, ThatIsLostThreeTimesFailsTheJobAndSaysWhy) {
  const std::string id = add();
  for (int attempt = 1; attempt <= 3; ++attempt) {
    ASSERT_TRUE(becomes(id, JobState::kQueued));
    ASSERT_EQ(hasty_->lease()->attempt, attempt);
  }
  ASSERT_TRUE(becomes(id, JobState::kFailed));
  EXPECT_NE(calm_->find(id)->error.find("its agent fell silent"), std::string::npos)
      << calm_->find(id)->error;
}

TEST_F(PostgresLease, IsGivenToOneOfManyAgents) {
  constexpr int kJobs = 40;
  for (int i = 0; i < kJobs; ++i) add();
  std::vector<std::vector<std::string>> leased(4);
  std::vector<std::thread> agents;
  for (auto& mine : leased)
    agents.emplace_back([this, &mine] {
      const std::unique_ptr<Store> store = open_postgres_store(uri_);
      while (const std::optional<Job> job = store->lease()) mine.push_back(job->id);
    });
  for (std::thread& agent : agents) agent.join();
  std::set<std::string> all;
  std::size_t count = 0;
  for (const auto& mine : leased) {
    count += mine.size();
    all.insert(mine.begin(), mine.end());
  }
  EXPECT_EQ(count, static_cast<std::size_t>(kJobs));
  EXPECT_EQ(all.size(), static_cast<std::size_t>(kJobs));
}

TEST(PostgresStore, ManyProcessesMayOpenAnEmptyDatabaseAtOnce) {
  const std::string uri = cluster().new_database();
  std::vector<std::unique_ptr<Store>> stores(6);
  std::vector<std::thread> openers;
  for (auto& store : stores) openers.emplace_back([&store, &uri] { store = open_postgres_store(uri); });
  for (std::thread& opener : openers) opener.join();
  const Submission submission = sample_submission("foam");
  ASSERT_FALSE(stores.front()->add(submission));
  EXPECT_TRUE(stores.back()->find(submission.job.id));
}

TEST(PostgresStore, KeepsWhatComesAfterANulCharacter) {
  const std::unique_ptr<Store> store = open_postgres_store(cluster().new_database());
  const Submission submission = sample_submission(std::string("be\0fore", 7));
  ASSERT_FALSE(store->add(submission));
  EXPECT_EQ(store->find(submission.job.id)->name, "be\uFFFDfore");
}

TEST(PostgresStore, GoesOnWhenItsConnectionBreaks) {
  const std::unique_ptr<Store> store = open_postgres_store(cluster().new_database());
  const Submission submission = sample_submission("foam");
  ASSERT_FALSE(store->add(submission));
  cluster().drop_connections();
  EXPECT_TRUE(store->find(submission.job.id));
  cluster().drop_connections();
  EXPECT_EQ(store->lease()->id, submission.job.id);
}

TEST(PostgresStore, DoesNotRepeatThePasswordWhenItCannotConnect) {
  PostgresSettings impatient;
  impatient.patience = std::chrono::milliseconds(0);
  for (const char* uri :
       {"postgresql://user:secret@127.0.0.1:1/none", "postgresql://user:secret@host:port/none",
        "postgresql://user:secret@127.0.0.1/none?nonsense=1"}) {
    try {
      static_cast<void>(open_postgres_store(uri, impatient));
      FAIL() << uri;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find("secret"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("cannot reach the database"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace lather::server
