#include "server/job/job.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace lather::server {
namespace {

using S = JobState;

const std::vector<S> kAll = {S::kQueued,     S::kRunning,   S::kPausing,   S::kPaused,
                             S::kCancelling, S::kCancelled, S::kSucceeded, S::kFailed};

TEST(Job, HasExactlyTheTransitionsOfItsLife) {
  const std::set<std::pair<S, S>> expected = {
      {S::kQueued, S::kRunning},     {S::kQueued, S::kPaused},    {S::kQueued, S::kCancelled},
      {S::kRunning, S::kSucceeded},  {S::kRunning, S::kFailed},   {S::kRunning, S::kPausing},
      {S::kRunning, S::kCancelling}, {S::kRunning, S::kQueued},   {S::kPausing, S::kPaused},
      {S::kPausing, S::kSucceeded},  {S::kPausing, S::kFailed},   {S::kPausing, S::kCancelling},
      {S::kPaused, S::kQueued},      {S::kPaused, S::kCancelled}, {S::kCancelling, S::kCancelled},
      {S::kCancelled, S::kQueued},   {S::kSucceeded, S::kQueued}, {S::kFailed, S::kQueued}};
  for (const S from : kAll)
    for (const S to : kAll)
      EXPECT_EQ(can_move(from, to), expected.count({from, to}) == 1)
          << to_string(from) << " -> " << to_string(to);
}

TEST(Job, EndsInThreeStatesAndPublishesInTwo) {
  for (const S state : kAll) {
    const bool last = state == S::kCancelled || state == S::kSucceeded || state == S::kFailed;
    EXPECT_EQ(has_ended(state), last) << to_string(state);
    EXPECT_EQ(attempt_stands(state), state == S::kRunning || state == S::kPausing) << to_string(state);
    EXPECT_EQ(is_at_work(state), attempt_stands(state) || state == S::kCancelling) << to_string(state);
  }
}

TEST(Job, ALostAttemptLeadsWhereTheUserWantedUntilTheThird) {
  EXPECT_EQ(after_loss(S::kRunning, 1), S::kQueued);
  EXPECT_EQ(after_loss(S::kRunning, 2), S::kQueued);
  EXPECT_EQ(after_loss(S::kRunning, 3), S::kFailed);
  EXPECT_EQ(after_loss(S::kPausing, 3), S::kPaused);
  EXPECT_EQ(after_loss(S::kCancelling, 3), S::kCancelled);
  for (const S state : kAll) {
    if (is_at_work(state))
      EXPECT_TRUE(can_move(state, after_loss(state, 1))) << to_string(state);
    else
      EXPECT_EQ(after_loss(state, 3), state) << to_string(state);
  }
}

TEST(Job, StateNamesReadBack) {
  for (const S state : kAll) EXPECT_EQ(job_state_from_string(to_string(state)), state);
  EXPECT_THROW(static_cast<void>(job_state_from_string("asleep")), std::invalid_argument);
}

TEST(Job, IdsAreTwentyTwoPlainCharactersAndDiffer) {
  std::set<std::string> ids;
  for (int i = 0; i < 1000; ++i) ids.insert(new_job_id());
  EXPECT_EQ(ids.size(), 1000u);
  for (const std::string& id : ids) EXPECT_TRUE(is_job_id(id)) << id;
  EXPECT_FALSE(is_job_id("short"));
  EXPECT_FALSE(is_job_id("../../../../etc/passwd"));
  EXPECT_FALSE(is_job_id("aaaaaaaaaaaaaaaaaaaaaa "));
}

TEST(Job, TimestampsAreUtcWithMilliseconds) {
  EXPECT_EQ(timestamp(1700000000042), "2023-11-14T22:13:20.042Z");
}

}  // namespace
}  // namespace lather::server
