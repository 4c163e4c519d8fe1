#include "tests/server/store_test.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace lather::server {

Submission sample_submission(const std::string& name) {
  Submission submission;
  submission.job.id = new_job_id();
  submission.job.name = name;
  submission.job.created = now_ms();
  submission.job.points = 1234;
  submission.job.frame_rate = 23.976;
  submission.job.progress.frames = 4;
  submission.job.request_digest = "digest of " + name;
  submission.scene = "{\"scene\":\"" + name + "\"}";
  submission.plan = "{\"plan\":\"" + name + "\"}";
  return submission;
}

std::string StoreTest::add(const std::string& name, int priority, const std::string& key) {
  Submission submission = sample_submission(name);
  submission.job.priority = priority;
  submission.job.idempotency_key = key;
  const std::optional<Job> earlier = store_->add(submission);
  return earlier ? earlier->id : submission.job.id;
}

namespace {

class SqlitePlace final : public StorePlace {
 public:
  std::unique_ptr<Store> open() override { return open_sqlite_store(directory_.path() / "lather.db"); }

 private:
  TemporaryDirectory directory_;
};

std::unique_ptr<StorePlace> new_sqlite_place() {
  return std::make_unique<SqlitePlace>();
}

INSTANTIATE_TEST_SUITE_P(Sqlite, StoreTest, ::testing::Values(StoreKind{"Sqlite", new_sqlite_place}));

TEST_P(StoreTest, KeepsAJobAndItsDocumentsAcrossReopening) {
  const std::string id = add("foam", 3);
  reopen();
  const std::optional<Job> job = store_->find(id);
  ASSERT_TRUE(job);
  EXPECT_EQ(job->name, "foam");
  EXPECT_EQ(job->state, JobState::kQueued);
  EXPECT_EQ(job->priority, 3);
  EXPECT_EQ(job->points, 1234u);
  EXPECT_EQ(job->frame_rate, 23.976);
  EXPECT_EQ(job->progress.frames, 4);
  EXPECT_EQ(store_->plan(id), "{\"plan\":\"foam\"}");
  EXPECT_EQ(store_->scene(id), "{\"scene\":\"foam\"}");
  EXPECT_FALSE(store_->find(new_job_id()));
}

TEST_P(StoreTest, LeasesByPriorityThenAgeAndEachJobOnce) {
  const std::string first = add("first");
  const std::string second = add("second");
  const std::string urgent = add("urgent", 1);
  EXPECT_EQ(store_->lease()->id, urgent);
  const std::optional<Job> leased = store_->lease();
  EXPECT_EQ(leased->id, first);
  EXPECT_EQ(leased->state, JobState::kRunning);
  EXPECT_EQ(leased->attempt, 1);
  EXPECT_EQ(store_->lease()->id, second);
  EXPECT_FALSE(store_->lease());
}

TEST_P(StoreTest, RefusesTransitionsThatDoNotExist) {
  const std::string id = add("foam");
  EXPECT_FALSE(store_->move(id, JobState::kSucceeded));
  EXPECT_FALSE(store_->move(id, JobState::kCancelling));
  EXPECT_EQ(store_->find(id)->state, JobState::kQueued);
  ASSERT_TRUE(store_->lease());
  EXPECT_TRUE(store_->move(id, JobState::kFailed, "it broke"));
  EXPECT_EQ(store_->find(id)->error, "it broke");
  EXPECT_GT(store_->find(id)->ended, 0);
  EXPECT_FALSE(store_->move(id, JobState::kRunning));
  EXPECT_FALSE(store_->move(new_job_id(), JobState::kCancelled));
}

TEST_P(StoreTest, PublishesFramesOnlyWhileTheAttemptStands) {
  const std::string id = add("foam");
  EXPECT_FALSE(store_->publish(id, 1, {0, "sha", 10, 1}));
  ASSERT_TRUE(store_->lease());
  EXPECT_TRUE(store_->publish(id, 1, {0, "sha of first", 10, 1}));
  EXPECT_FALSE(store_->publish(id, 2, {1, "sha", 10, 2}));
  ASSERT_TRUE(store_->move(id, JobState::kCancelling));
  EXPECT_FALSE(store_->publish(id, 1, {1, "sha", 10, 1}));
  EXPECT_FALSE(store_->set_progress(id, 1, JobProgress{}));
  EXPECT_EQ(store_->count_frames(id), 1u);
}

TEST_P(StoreTest, KeepsProgressToTheLastBit) {
  const std::string id = add("foam \u00fc\u4e16 'quoted'; --");
  ASSERT_TRUE(store_->lease());
  JobProgress progress;
  progress.frame = 3;
  progress.frames = 4;
  progress.time = 0.1 + 0.2;
  progress.fraction = 1.0 / 3;
  progress.step = 1234567890123;
  progress.seconds_per_frame = 1e-7;
  progress.eta_seconds = 1e9 + 0.1;
  ASSERT_TRUE(store_->set_progress(id, 1, progress));
  reopen();
  const std::optional<Job> job = store_->find(id);
  ASSERT_TRUE(job);
  EXPECT_EQ(job->name, "foam \u00fc\u4e16 'quoted'; --");
  EXPECT_EQ(job->progress.time, progress.time);
  EXPECT_EQ(job->progress.fraction, progress.fraction);
  EXPECT_EQ(job->progress.step, progress.step);
  EXPECT_EQ(job->progress.seconds_per_frame, progress.seconds_per_frame);
  EXPECT_EQ(job->progress.eta_seconds, progress.eta_seconds);
}

TEST_P(StoreTest, KeepsOldFramesUntilANewAttemptReplacesThem) {
  const std::string id = add("foam");
  ASSERT_TRUE(store_->lease());
  ASSERT_TRUE(store_->publish(id, 1, {0, "old", 10, 1}));
  ASSERT_TRUE(store_->publish(id, 1, {1, "old", 10, 1}));
  ASSERT_TRUE(store_->settle(id, 1, JobState::kQueued));
  const std::optional<Job> again = store_->lease();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->attempt, 2);
  ASSERT_TRUE(store_->publish(id, 2, {0, "new", 11, 2}));
  const std::vector<FrameRow> frames = store_->frames(id);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].sha256, "new");
  EXPECT_EQ(frames[0].attempt, 2);
  EXPECT_EQ(frames[1].sha256, "old");
  EXPECT_EQ(frames[1].attempt, 1);
}

TEST_P(StoreTest, RefusesEveryWriteOfAnOlderAttempt) {
  const std::string id = add("foam");
  ASSERT_TRUE(store_->lease());
  ASSERT_TRUE(store_->settle(id, 1, JobState::kQueued));
  EXPECT_FALSE(store_->heartbeat(id, 1)) << "a queued job has no attempt that stands";
  ASSERT_TRUE(store_->lease());
  EXPECT_FALSE(store_->heartbeat(id, 1));
  EXPECT_FALSE(store_->publish(id, 1, {1, "late", 12, 1}));
  EXPECT_FALSE(store_->set_progress(id, 1, JobProgress{}));
  EXPECT_FALSE(store_->settle(id, 1, JobState::kFailed, "late"));
  EXPECT_FALSE(store_->settle(id, 1, JobState::kQueued));
  EXPECT_EQ(store_->find(id)->state, JobState::kRunning);
  EXPECT_EQ(store_->find(id)->error, "");
  EXPECT_EQ(store_->count_frames(id), 0u);
}

TEST_P(StoreTest, AHeartbeatSaysWhetherToGoOnOrToCancel) {
  const std::string id = add("foam");
  ASSERT_TRUE(store_->lease());
  EXPECT_EQ(store_->heartbeat(id, 1), JobState::kRunning);
  ASSERT_TRUE(store_->move(id, JobState::kCancelling));
  EXPECT_EQ(store_->heartbeat(id, 1), JobState::kCancelling);
  ASSERT_TRUE(store_->settle(id, 1, JobState::kCancelled));
  EXPECT_FALSE(store_->heartbeat(id, 1));
}

TEST_P(StoreTest, KeepsCheckpointsOfTheAttemptThatStandsTheLastOnesFirst) {
  const std::string id = add("foam");
  EXPECT_FALSE(store_->add_checkpoint(id, {1, 10, 0.1, 1000}));
  EXPECT_LT(store_->find(id)->checkpoint_time, 0);
  ASSERT_TRUE(store_->lease());
  EXPECT_TRUE(store_->add_checkpoint(id, {1, 10, 0.1, 1000}));
  EXPECT_TRUE(store_->add_checkpoint(id, {1, 30, 0.3, 3000}));
  EXPECT_TRUE(store_->add_checkpoint(id, {1, 30, 0.3, 3000})) << "the same again is no other";
  EXPECT_FALSE(store_->add_checkpoint(id, {2, 40, 0.4, 4000}));
  ASSERT_TRUE(store_->settle(id, 1, JobState::kQueued));
  EXPECT_FALSE(store_->add_checkpoint(id, {1, 50, 0.5, 5000}));
  ASSERT_TRUE(store_->lease());
  // It could not use the later checkpoint: what it makes is good, though of an earlier step.
  EXPECT_TRUE(store_->add_checkpoint(id, {2, 20, 0.2, 2000}));
  EXPECT_EQ(store_->find(id)->checkpoint_time, 0.2);
  reopen();
  std::vector<CheckpointRow> rows = store_->checkpoints(id);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].step, 20U);
  EXPECT_EQ(rows[0].attempt, 2);
  EXPECT_EQ(rows[1].step, 30U);
  EXPECT_EQ(rows[2].step, 10U);
  rows = store_->drop_checkpoints(id, 2);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].step, 10U);
  EXPECT_EQ(rows[0].attempt, 1);
  EXPECT_TRUE(store_->drop_checkpoints(id, 2).empty());
  EXPECT_EQ(store_->checkpoints(id).size(), 2U);
  ASSERT_TRUE(store_->move(id, JobState::kFailed, "why"));
  EXPECT_TRUE(store_->remove(id));
  EXPECT_TRUE(store_->checkpoints(id).empty());
}

TEST_P(StoreTest, ThreeLossesWithoutACheckpointBetweenThemFailAJob) {
  const std::string id = add("foam");
  const auto lose = [&](int attempt) {
    EXPECT_EQ(store_->lease()->attempt, attempt);
    return store_->lose(id, attempt, "it burnt");
  };
  EXPECT_EQ(lose(1), JobState::kQueued);
  EXPECT_EQ(lose(2), JobState::kQueued);
  EXPECT_EQ(store_->find(id)->losses, 2);
  EXPECT_EQ(store_->lease()->attempt, 3);
  ASSERT_TRUE(store_->add_checkpoint(id, {3, 10, 0.1, 1000}));
  EXPECT_EQ(store_->find(id)->losses, 0);
  EXPECT_EQ(store_->lose(id, 3, "it burnt"), JobState::kQueued);
  EXPECT_EQ(lose(4), JobState::kQueued);
  EXPECT_EQ(lose(5), JobState::kFailed);
  const std::string error = store_->find(id)->error;
  EXPECT_NE(error.find("3 attempts in a row"), std::string::npos) << error;
  EXPECT_NE(error.find("it burnt"), std::string::npos) << error;
  EXPECT_FALSE(store_->lose(id, 5, "late"));
  EXPECT_FALSE(store_->lose(new_job_id(), 1, "unknown"));
  // A retry forgets them.
  ASSERT_TRUE(store_->requeue(id, JobState::kFailed));
  EXPECT_EQ(store_->find(id)->error, "");
  EXPECT_EQ(store_->find(id)->ended, 0);
  EXPECT_EQ(lose(6), JobState::kQueued);
}

TEST_P(StoreTest, ALossWhilePausingOrCancellingDoesWhatWasAsked) {
  const std::string pausing = add("foam");
  ASSERT_TRUE(store_->lease());
  ASSERT_TRUE(store_->move(pausing, JobState::kPausing));
  EXPECT_EQ(store_->heartbeat(pausing, 1), JobState::kPausing);
  EXPECT_TRUE(store_->publish(pausing, 1, {0, "sha", 10, 1})) << "frames before the checkpoint still count";
  EXPECT_TRUE(store_->set_progress(pausing, 1, JobProgress{}));
  EXPECT_EQ(store_->lose(pausing, 1, "it burnt"), JobState::kPaused);
  EXPECT_FALSE(store_->lease()) << "a paused job waits";
  EXPECT_TRUE(store_->requeue(pausing, JobState::kPaused));
  ASSERT_TRUE(store_->lease());
  ASSERT_TRUE(store_->move(pausing, JobState::kCancelling));
  EXPECT_EQ(store_->lose(pausing, 2, "it burnt"), JobState::kCancelled);
}

TEST_P(StoreTest, QueuesAgainOnlyFromWhereTheJobIs) {
  const std::string id = add("foam");
  EXPECT_FALSE(store_->requeue(id, JobState::kQueued));
  EXPECT_FALSE(store_->requeue(id, JobState::kPaused));
  ASSERT_TRUE(store_->lease());
  EXPECT_FALSE(store_->requeue(id, JobState::kPaused));
  EXPECT_FALSE(store_->requeue(new_job_id(), JobState::kFailed));
}

TEST_P(StoreTest, AFinishedJobIsMadeLongerAndKeepsItsFrames) {
  const std::string id = add("foam");
  const LongerRun longer = {"{\"scene\":2}", "{\"plan\":2}", 8, 4321};
  EXPECT_FALSE(store_->extend(id, longer)) << "it has not succeeded";
  ASSERT_TRUE(store_->lease());
  JobProgress progress;
  progress.frames = 4;
  progress.fraction = 1;
  ASSERT_TRUE(store_->set_progress(id, 1, progress));
  ASSERT_TRUE(store_->publish(id, 1, {0, "sha", 10, 1}));
  ASSERT_TRUE(store_->settle(id, 1, JobState::kSucceeded));
  EXPECT_TRUE(store_->extend(id, longer));
  EXPECT_FALSE(store_->extend(id, longer)) << "once is enough";
  const std::optional<Job> job = store_->lease();
  ASSERT_TRUE(job);
  EXPECT_EQ(job->attempt, 2);
  EXPECT_EQ(job->progress.frames, 8);
  EXPECT_EQ(job->progress.fraction, 0.5);
  EXPECT_EQ(job->points, 4321U);
  EXPECT_EQ(job->ended, 0);
  EXPECT_EQ(store_->plan(id), longer.plan);
  EXPECT_EQ(store_->scene(id), longer.scene);
  EXPECT_EQ(store_->count_frames(id), 1U);
}

TEST_P(StoreTest, PriorityMayChangeUntilAJobEnds) {
  add("first");
  const std::string second = add("second");
  EXPECT_TRUE(store_->set_priority(second, 5));
  EXPECT_EQ(store_->lease()->id, second);
  ASSERT_TRUE(store_->settle(second, 1, JobState::kSucceeded));
  EXPECT_FALSE(store_->set_priority(second, 6));
  EXPECT_EQ(store_->find(second)->priority, 5);
  EXPECT_FALSE(store_->set_priority(new_job_id(), 1));
}

TEST(SqliteStore, RecoveryQueuesRunningJobsAndCancelsCancellingOnes) {
  SqlitePlace place;
  std::unique_ptr<Store> store = place.open();
  const auto add = [&](const char* name) {
    const Submission submission = sample_submission(name);
    store->add(submission);
    return submission.job.id;
  };
  const std::string running = add("running");
  const std::string cancelling = add("cancelling");
  const std::string queued = add("queued");
  ASSERT_TRUE(store->lease());
  ASSERT_TRUE(store->lease());
  ASSERT_TRUE(store->move(cancelling, JobState::kCancelling));
  EXPECT_EQ(store->reclaim(), 0u) << "leases last as long as their process";
  store.reset();
  store = place.open();
  EXPECT_EQ(store->recover(), 2u);
  EXPECT_EQ(store->find(running)->state, JobState::kQueued);
  EXPECT_EQ(store->find(running)->losses, 1);
  EXPECT_EQ(store->find(cancelling)->state, JobState::kCancelled);
  EXPECT_EQ(store->find(queued)->state, JobState::kQueued);
}

TEST(SqliteStore, ADatabaseOfVersion1IsBroughtUpToDate) {
  TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "lather.db";
  std::string id;
  {
    const std::unique_ptr<Store> store = open_sqlite_store(file);
    id = new_job_id();
    Submission submission = sample_submission("old");
    submission.job.id = id;
    store->add(submission);
  }
  {  // what version 2 added is taken away again
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    database.exec(
        "DROP TABLE checkpoints; ALTER TABLE jobs DROP COLUMN losses; UPDATE schema SET version = 1");
  }
  const std::unique_ptr<Store> store = open_sqlite_store(file);
  EXPECT_EQ(store->lease()->id, id);
  EXPECT_TRUE(store->add_checkpoint(id, {1, 10, 0.1, 1000}));
  EXPECT_EQ(store->find(id)->losses, 0);
}

TEST(SqliteStore, ADatabaseOfALaterVersionIsRefused) {
  TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "lather.db";
  static_cast<void>(open_sqlite_store(file));
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("UPDATE schema SET version = 99");
  EXPECT_THROW(static_cast<void>(open_sqlite_store(file)), std::runtime_error);
}

TEST_P(StoreTest, PagesThroughAllJobsNewestFirstWhileNewOnesArrive) {
  std::vector<std::string> added;
  for (int i = 0; i < 7; ++i) added.push_back(add("job " + std::to_string(i)));
  Listing listing;
  listing.limit = 3;
  std::vector<std::string> seen;
  do {
    const JobPage page = store_->list(listing);
    for (const Job& job : page.jobs) seen.push_back(job.id);
    listing.cursor = page.next_cursor;
    add("arrives in between");
  } while (!listing.cursor.empty());
  EXPECT_EQ(seen, std::vector<std::string>(added.rbegin(), added.rend()));
}

TEST_P(StoreTest, ListsByStateAndRefusesForgedCursors) {
  add("a");
  add("b");
  ASSERT_TRUE(store_->lease());
  Listing listing;
  listing.state = JobState::kRunning;
  EXPECT_EQ(store_->list(listing).jobs.size(), 1u);
  for (const char* forged : {"x", "-1", "1 OR 1=1", "99999999999999999999"}) {
    listing.cursor = forged;
    EXPECT_THROW(static_cast<void>(store_->list(listing)), std::invalid_argument) << forged;
  }
}

TEST_P(StoreTest, TheSameIdempotencyKeyMakesOneJob) {
  const std::string first = add("foam", 0, "key-1");
  EXPECT_EQ(add("foam", 0, "key-1"), first);
  EXPECT_NE(add("foam", 0, "key-2"), first);
  EXPECT_NE(add("foam"), add("foam"));
  EXPECT_EQ(store_->count(JobState::kQueued), 4u);
}

TEST_P(StoreTest, RemovesOnlyEndedJobsAndTheirFrames) {
  const std::string id = add("foam");
  EXPECT_FALSE(store_->remove(id));
  ASSERT_TRUE(store_->lease());
  ASSERT_TRUE(store_->publish(id, 1, {0, "sha", 10, 1}));
  EXPECT_FALSE(store_->remove(id));
  ASSERT_TRUE(store_->move(id, JobState::kSucceeded));
  EXPECT_TRUE(store_->remove(id));
  EXPECT_FALSE(store_->find(id));
  EXPECT_TRUE(store_->frames(id).empty());
}

TEST_P(StoreTest, GivesEachJobToOneOfManyThreads) {
  constexpr int kJobs = 24;
  for (int i = 0; i < kJobs; ++i) add("job");
  std::vector<std::vector<std::string>> leased(4);
  std::vector<std::thread> threads;
  for (auto& mine : leased)
    threads.emplace_back([this, &mine] {
      while (const std::optional<Job> job = store_->lease()) mine.push_back(job->id);
    });
  for (std::thread& thread : threads) thread.join();
  std::set<std::string> all;
  std::size_t count = 0;
  for (const auto& mine : leased) {
    count += mine.size();
    all.insert(mine.begin(), mine.end());
  }
  EXPECT_EQ(count, static_cast<std::size_t>(kJobs));
  EXPECT_EQ(all.size(), static_cast<std::size_t>(kJobs));
}

}  // namespace
}  // namespace lather::server
