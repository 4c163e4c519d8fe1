#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <mutex>
#include <pqxx/pqxx>
#include <stdexcept>
#include <thread>
#include <utility>

#include "server/store/store.h"

namespace lather::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kReconnectPause = std::chrono::milliseconds(100);

/// Any number that other programs in the same database are unlikely to lock: "lather" in ASCII.
constexpr const char* kLockSchema = "SELECT pg_advisory_xact_lock(118992968054130)";

/// Step i leads from version i to the next; a new database takes them all.
constexpr const char* kSchemaSteps[] = {R"sql(
CREATE TABLE lather_schema (version integer NOT NULL);
INSERT INTO lather_schema VALUES (1);
CREATE TABLE lather_jobs (
  sequence bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  id text NOT NULL UNIQUE,
  name text NOT NULL,
  state text NOT NULL,
  priority integer NOT NULL,
  created bigint NOT NULL,
  started bigint NOT NULL DEFAULT 0,
  ended bigint NOT NULL DEFAULT 0,
  attempt integer NOT NULL DEFAULT 0,
  error text NOT NULL DEFAULT '',
  points bigint NOT NULL,
  frame_rate double precision NOT NULL,
  frame integer NOT NULL DEFAULT 0,
  frames integer NOT NULL,
  time double precision NOT NULL DEFAULT 0,
  fraction double precision NOT NULL DEFAULT 0,
  step bigint NOT NULL DEFAULT 0,
  seconds_per_frame double precision NOT NULL DEFAULT 0,
  eta_seconds double precision NOT NULL DEFAULT -1,
  idempotency_key text UNIQUE,
  request_digest text NOT NULL,
  lease_until timestamptz,
  losses integer NOT NULL DEFAULT 0,
  scene text NOT NULL,
  plan text NOT NULL);
CREATE INDEX lather_jobs_by_state ON lather_jobs (state, priority DESC, sequence);
CREATE TABLE lather_frames (
  job text NOT NULL REFERENCES lather_jobs (id) ON DELETE CASCADE,
  number integer NOT NULL,
  sha256 text NOT NULL,
  size bigint NOT NULL,
  attempt integer NOT NULL,
  PRIMARY KEY (job, number));
)sql",
                                        R"sql(
CREATE TABLE lather_checkpoints (
  job text NOT NULL REFERENCES lather_jobs (id) ON DELETE CASCADE,
  attempt integer NOT NULL,
  step bigint NOT NULL,
  time double precision NOT NULL,
  size bigint NOT NULL,
  PRIMARY KEY (job, attempt, step));
UPDATE lather_schema SET version = 2;
)sql"};
constexpr int kSchemaVersion = std::size(kSchemaSteps);

// The database's clock, in ms since 1970 (the store's form) and as the end of a lease of $1 ms.
#define LATHER_NOW_MS "floor(extract(epoch FROM clock_timestamp()) * 1000)::bigint"
#define LATHER_LEASE_END "clock_timestamp() + $1::bigint * interval '1 millisecond'"
/// The order in which read_job() takes them.
#define LATHER_JOB_COLUMNS                                                                                  \
  "id, name, state, priority, created, started, ended, attempt, error, points, frame_rate, frame, frames, " \
  "time, fraction, step, seconds_per_frame, eta_seconds, coalesce(idempotency_key, ''), request_digest, "   \
  "losses, coalesce((SELECT c.time FROM lather_checkpoints c WHERE c.job = lather_jobs.id"                  \
  " ORDER BY c.attempt DESC, c.step DESC LIMIT 1), -1), sequence"

constexpr int kSequenceColumn = 22;

constexpr const char* kInsert =
    "INSERT INTO lather_jobs (id, name, state, priority, created, points, frame_rate, frames,"
    " idempotency_key, request_digest, scene, plan)"
    " VALUES ($1, $2, 'queued', $3, $4, $5, $6, $7, nullif($8, ''), $9, $10, $11)"
    " ON CONFLICT (idempotency_key) DO NOTHING RETURNING id";

constexpr const char* kList = "SELECT " LATHER_JOB_COLUMNS
                              " FROM lather_jobs WHERE sequence < $1 AND ($2 = '' OR state = $2)"
                              " ORDER BY sequence DESC LIMIT $3";

// Rows that another agent is just taking are skipped, not waited for; materialized, so that the choice is
// made once.
constexpr const char* kLease =
    "WITH first AS MATERIALIZED (SELECT id AS chosen FROM lather_jobs WHERE state = 'queued'"
    "  ORDER BY priority DESC, sequence LIMIT 1 FOR UPDATE SKIP LOCKED)"
    " UPDATE lather_jobs SET state = 'running', attempt = attempt + 1, ended = 0,"
    "  started = " LATHER_NOW_MS ", lease_until = " LATHER_LEASE_END
    ","
    "  eta_seconds = -1"
    " FROM first WHERE id = chosen RETURNING " LATHER_JOB_COLUMNS;

constexpr const char* kHeartbeat =
    "UPDATE lather_jobs SET lease_until = " LATHER_LEASE_END
    " WHERE id = $2 AND attempt = $3 AND state IN ('running', 'pausing', 'cancelling') RETURNING state";

constexpr const char* kLost = "SELECT " LATHER_JOB_COLUMNS
                              " FROM lather_jobs WHERE state IN ('running', 'pausing', 'cancelling')"
                              " AND lease_until < clock_timestamp() FOR UPDATE SKIP LOCKED";

constexpr const char* kFellSilent =
    "its agent fell silent (its machine, its program or its way to the database). A job that needs more "
    "memory than its machine has does that: choose a larger spacing";

constexpr const char* kWriteState =
    "UPDATE lather_jobs SET state = $1, error = $2, losses = $3,"
    " ended = CASE WHEN $4 THEN " LATHER_NOW_MS " ELSE 0 END WHERE id = $5";

constexpr const char* kExtend =
    "UPDATE lather_jobs SET scene = $1, plan = $2, fraction = fraction * frames / greatest(1, $3::integer),"
    " frames = $3::integer, points = $4 WHERE id = $5";

constexpr const char* kProgress =
    "UPDATE lather_jobs SET frame = $1, frames = $2, time = $3, fraction = $4, step = $5,"
    " seconds_per_frame = $6, eta_seconds = $7 WHERE id = $8 AND attempt = $9 AND state IN ('running', "
    "'pausing')";

constexpr const char* kPublish =
    "INSERT INTO lather_frames (job, number, sha256, size, attempt) VALUES ($1, $2, $3, $4, $5)"
    " ON CONFLICT (job, number) DO UPDATE SET sha256 = excluded.sha256, size = excluded.size,"
    " attempt = excluded.attempt";

constexpr const char* kAddCheckpoint =
    "INSERT INTO lather_checkpoints (job, attempt, step, time, size) VALUES ($1, $2, $3, $4, $5)"
    " ON CONFLICT (job, attempt, step) DO UPDATE SET time = excluded.time, size = excluded.size";

Job read_job(const pqxx::row& row) {
  Job job;
  int i = 0;
  const auto next = [&](auto& field) { row[i++].to(field); };
  std::string state;
  std::int64_t points = 0;
  std::int64_t step = 0;
  next(job.id);
  next(job.name);
  next(state);
  next(job.priority);
  next(job.created);
  next(job.started);
  next(job.ended);
  next(job.attempt);
  next(job.error);
  next(points);
  next(job.frame_rate);
  next(job.progress.frame);
  next(job.progress.frames);
  next(job.progress.time);
  next(job.progress.fraction);
  next(step);
  next(job.progress.seconds_per_frame);
  next(job.progress.eta_seconds);
  next(job.idempotency_key);
  next(job.request_digest);
  next(job.losses);
  next(job.checkpoint_time);
  job.state = job_state_from_string(state);
  job.points = static_cast<std::uint64_t>(points);
  job.progress.step = static_cast<std::uint64_t>(step);
  return job;
}

std::optional<Job> job_of(const pqxx::result& rows) {
  if (rows.empty()) return std::nullopt;
  return read_job(rows[0]);
}

FrameRow read_frame(const pqxx::row& row) {
  return {row[0].as<int>(), row[1].as<std::string>(), static_cast<std::uint64_t>(row[2].as<std::int64_t>()),
          row[3].as<int>()};
}

/// PostgreSQL's texts cannot hold NUL, which a name may: it becomes U+FFFD.
std::string storable(std::string text) {
  for (std::size_t at = text.find('\0'); at != std::string::npos; at = text.find('\0', at))
    text.replace(at, 1, "\uFFFD");
  return text;
}

/// A server that is gone without a word is noticed in seconds, not after TCP's quarter of an hour. What the
/// user wrote comes first.
std::string with_timeouts(std::string uri) {
  const std::pair<const char*, const char*> defaults[] = {
      {"connect_timeout", "5"}, {"tcp_user_timeout", "10000"}, {"fallback_application_name", "lather"}};
  for (const auto& [name, value] : defaults) {
    if (uri.find(std::string(name) + '=') != std::string::npos) continue;
    uri += uri.find('?') == std::string::npos ? '?' : '&';
    uri += std::string(name) + '=' + value;
  }
  return uri;
}

class PostgresStore final : public Store {
 public:
  PostgresStore(const std::string& uri, const PostgresSettings& settings)
      : uri_(with_timeouts(uri)), settings_(settings) {
    transact([](pqxx::work& t) {
      t.exec(kLockSchema);
      const bool fresh = t.exec1("SELECT to_regclass('lather_schema') IS NULL")[0].as<bool>();
      const int version = fresh ? 0 : t.exec1("SELECT version FROM lather_schema")[0].as<int>();
      if (version > kSchemaVersion)
        throw std::runtime_error("the database has schema version " + std::to_string(version) +
                                 ", this build reads up to version " + std::to_string(kSchemaVersion));
      for (int step = version; step < kSchemaVersion; ++step) t.exec(kSchemaSteps[step]);
      return true;
    });
  }

  std::optional<Job> add(const Submission& submission) override {
    return transact([&](pqxx::work& t) -> std::optional<Job> {
      const Job& job = submission.job;
      const pqxx::result added =
          t.exec_params(kInsert, job.id, storable(job.name), job.priority, job.created,
                        static_cast<std::int64_t>(job.points), job.frame_rate, job.progress.frames,
                        job.idempotency_key, job.request_digest, submission.scene, submission.plan);
      if (!added.empty()) return std::nullopt;
      return job_of(t.exec_params("SELECT " LATHER_JOB_COLUMNS " FROM lather_jobs WHERE idempotency_key = $1",
                                  job.idempotency_key));
    });
  }

  std::optional<Job> find(const std::string& id) override {
    return transact([&](pqxx::work& t) {
      return job_of(t.exec_params("SELECT " LATHER_JOB_COLUMNS " FROM lather_jobs WHERE id = $1", id));
    });
  }

  std::optional<std::string> plan(const std::string& id) override {
    return document("SELECT plan FROM lather_jobs WHERE id = $1", id);
  }
  std::optional<std::string> scene(const std::string& id) override {
    return document("SELECT scene FROM lather_jobs WHERE id = $1", id);
  }

  JobPage list(const Listing& listing) override {
    const std::int64_t before = listing.cursor.empty() ? INT64_MAX : sequence_of_cursor(listing.cursor);
    const std::string only = listing.state ? to_string(*listing.state) : "";
    return transact([&](pqxx::work& t) {
      const pqxx::result rows =
          t.exec_params(kList, before, only, static_cast<std::int64_t>(listing.limit) + 1);
      JobPage page;
      for (const pqxx::row& row : rows) {
        if (page.jobs.size() == listing.limit) break;
        page.jobs.push_back(read_job(row));
        if (page.jobs.size() == listing.limit && rows.size() > listing.limit)
          page.next_cursor = row[kSequenceColumn].as<std::string>();
      }
      return page;
    });
  }

  std::size_t count(JobState state) override {
    return count_where("SELECT count(*) FROM lather_jobs WHERE state = $1", to_string(state));
  }

  std::optional<Job> lease() override {
    return transact([&](pqxx::work& t) {
      reclaim_in(t);
      return job_of(t.exec_params(kLease, term()));
    });
  }

  std::optional<JobState> heartbeat(const std::string& id, int attempt) override {
    return transact([&](pqxx::work& t) -> std::optional<JobState> {
      const pqxx::result rows = t.exec_params(kHeartbeat, term(), id, attempt);
      if (rows.empty()) return std::nullopt;
      return job_state_from_string(rows[0][0].as<std::string>());
    });
  }

  std::size_t reclaim() override {
    return transact([](pqxx::work& t) { return reclaim_in(t); });
  }

  bool move(const std::string& id, JobState to, const std::string& error) override {
    return move_if(id, std::nullopt, to, error);
  }
  bool settle(const std::string& id, int attempt, JobState to, const std::string& error) override {
    return move_if(id, attempt, to, error);
  }

  std::optional<JobState> lose(const std::string& id, int attempt, const std::string& why) override {
    return transact([&](pqxx::work& t) -> std::optional<JobState> {
      const std::optional<Job> job = lock_job(t, id);
      if (!job || job->attempt != attempt || !is_at_work(job->state)) return std::nullopt;
      return lose_in(t, *job, why);
    });
  }

  bool requeue(const std::string& id, JobState from) override { return requeue_with(id, from, nullptr); }
  bool extend(const std::string& id, const LongerRun& longer) override {
    return requeue_with(id, JobState::kSucceeded, &longer);
  }

  bool set_priority(const std::string& id, int priority) override {
    return transact([&](pqxx::work& t) {
      const std::optional<Job> job = lock_job(t, id);
      if (!job || has_ended(job->state)) return false;
      t.exec_params("UPDATE lather_jobs SET priority = $1 WHERE id = $2", priority, id);
      return true;
    });
  }

  bool set_progress(const std::string& id, int attempt, const JobProgress& p) override {
    return transact([&](pqxx::work& t) {
      return t.exec_params(kProgress, p.frame, p.frames, p.time, p.fraction,
                           static_cast<std::int64_t>(p.step), p.seconds_per_frame, p.eta_seconds, id, attempt)
                 .affected_rows() == 1;
    });
  }

  bool publish(const std::string& id, int attempt, const FrameRow& frame) override {
    return transact([&](pqxx::work& t) {
      const std::optional<Job> job = lock_job(t, id);
      if (!job || job->attempt != attempt || !attempt_stands(job->state)) return false;
      t.exec_params(kPublish, id, frame.index, frame.sha256, static_cast<std::int64_t>(frame.size), attempt);
      return true;
    });
  }

  bool add_checkpoint(const std::string& id, const CheckpointRow& checkpoint) override {
    return transact([&](pqxx::work& t) {
      const std::optional<Job> job = lock_job(t, id);
      if (!job || job->attempt != checkpoint.attempt || !attempt_stands(job->state)) return false;
      t.exec_params(kAddCheckpoint, id, checkpoint.attempt, static_cast<std::int64_t>(checkpoint.step),
                    checkpoint.time, static_cast<std::int64_t>(checkpoint.size));
      t.exec_params("UPDATE lather_jobs SET losses = 0 WHERE id = $1", id);
      return true;
    });
  }

  std::vector<CheckpointRow> checkpoints(const std::string& id) override {
    return transact([&](pqxx::work& t) { return checkpoints_in(t, id); });
  }

  std::vector<CheckpointRow> drop_checkpoints(const std::string& id, std::size_t keep) override {
    return transact([&](pqxx::work& t) {
      std::vector<CheckpointRow> rows = checkpoints_in(t, id);
      rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(std::min(keep, rows.size())));
      for (const CheckpointRow& row : rows)
        t.exec_params("DELETE FROM lather_checkpoints WHERE job = $1 AND attempt = $2 AND step = $3", id,
                      row.attempt, static_cast<std::int64_t>(row.step));
      return rows;
    });
  }

  using Store::frames;
  std::vector<FrameRow> frames(const std::string& id, int first) override {
    return transact([&](pqxx::work& t) {
      std::vector<FrameRow> found;
      for (const pqxx::row& row : t.exec_params("SELECT number, sha256, size, attempt FROM lather_frames"
                                                " WHERE job = $1 AND number >= $2 ORDER BY number",
                                                id, first))
        found.push_back(read_frame(row));
      return found;
    });
  }

  std::optional<FrameRow> frame(const std::string& id, int index) override {
    return transact([&](pqxx::work& t) -> std::optional<FrameRow> {
      const pqxx::result rows = t.exec_params(
          "SELECT number, sha256, size, attempt FROM lather_frames WHERE job = $1 AND number = $2", id,
          index);
      if (rows.empty()) return std::nullopt;
      return read_frame(rows[0]);
    });
  }

  std::size_t count_frames(const std::string& id) override {
    return count_where("SELECT count(*) FROM lather_frames WHERE job = $1", id);
  }

  bool remove(const std::string& id) override {
    return transact([&](pqxx::work& t) {
      const std::optional<Job> job = lock_job(t, id);
      if (!job || !has_ended(job->state)) return false;
      t.exec_params("DELETE FROM lather_jobs WHERE id = $1", id);
      return true;
    });
  }

  std::size_t recover() override { return reclaim(); }

 private:
  /// Runs `call` in a transaction, again on a new connection when the old one broke before the commit; what
  /// broke during the commit may have been kept and is not repeated.
  template <typename Call>
  auto transact(const Call& call) -> decltype(call(std::declval<pqxx::work&>())) {
    const std::lock_guard lock(mutex_);
    const Clock::time_point give_up = Clock::now() + settings_.patience;
    while (true) {
      try {
        if (!connection_) connect();
        pqxx::work transaction(*connection_);
        auto result = call(transaction);
        transaction.commit();
        return result;
      } catch (const pqxx::in_doubt_error&) {
        connection_.reset();
        throw;
      } catch (const pqxx::failure&) {
        if (connection_ && connection_->is_open()) throw;
        connection_.reset();
        if (Clock::now() >= give_up) throw;
      }
      std::this_thread::sleep_for(kReconnectPause);
    }
  }

  void connect() {
    try {
      connection_ = std::make_unique<pqxx::connection>(uri_);
    } catch (const pqxx::failure& failure) {
      std::string why = failure.what();
      for (std::size_t at = why.find(uri_); at != std::string::npos; at = why.find(uri_))
        why.replace(at, uri_.size(), "postgresql://…");
      throw pqxx::broken_connection("cannot reach the database: " + why);
    }
  }

  [[nodiscard]] std::int64_t term() const { return settings_.lease_term.count(); }

  static std::size_t reclaim_in(pqxx::work& t) {
    const pqxx::result rows = t.exec(kLost);
    for (const pqxx::row& row : rows) lose_in(t, read_job(row), kFellSilent);
    return rows.size();
  }

  static void write_state(pqxx::work& t, const std::string& id, JobState to, const std::string& error,
                          int losses) {
    t.exec_params(kWriteState, to_string(to), storable(error), losses, has_ended(to), id);
  }

  /// Of a row that is locked.
  static JobState lose_in(pqxx::work& t, const Job& job, const std::string& why) {
    const int losses = job.losses + 1;
    const JobState next = after_loss(job.state, losses);
    write_state(t, job.id, next, next == JobState::kFailed ? lost_too_often(why) : job.error, losses);
    return next;
  }

  bool requeue_with(const std::string& id, JobState from, const LongerRun* longer) {
    return transact([&](pqxx::work& t) {
      const std::optional<Job> job = lock_job(t, id);
      if (!job || job->state != from || !can_move(from, JobState::kQueued)) return false;
      write_state(t, id, JobState::kQueued, "", 0);
      if (longer)
        t.exec_params(kExtend, longer->scene, longer->plan, longer->frames,
                      static_cast<std::int64_t>(longer->points), id);
      return true;
    });
  }

  static std::vector<CheckpointRow> checkpoints_in(pqxx::work& t, const std::string& id) {
    std::vector<CheckpointRow> found;
    for (const pqxx::row& row :
         t.exec_params("SELECT attempt, step, time, size FROM lather_checkpoints WHERE job = $1"
                       " ORDER BY attempt DESC, step DESC",
                       id))
      found.push_back({row[0].as<int>(), static_cast<std::uint64_t>(row[1].as<std::int64_t>()),
                       row[2].as<double>(), static_cast<std::uint64_t>(row[3].as<std::int64_t>())});
    return found;
  }

  static std::optional<Job> lock_job(pqxx::work& t, const std::string& id) {
    return job_of(
        t.exec_params("SELECT " LATHER_JOB_COLUMNS " FROM lather_jobs WHERE id = $1 FOR UPDATE", id));
  }

  bool move_if(const std::string& id, std::optional<int> attempt, JobState to, const std::string& error) {
    return transact([&](pqxx::work& t) {
      const std::optional<Job> job = lock_job(t, id);
      if (!job || !can_move(job->state, to) || (attempt && job->attempt != *attempt)) return false;
      write_state(t, id, to, to == JobState::kFailed ? error : job->error, job->losses);
      return true;
    });
  }

  std::optional<std::string> document(const char* sql, const std::string& id) {
    return transact([&](pqxx::work& t) -> std::optional<std::string> {
      const pqxx::result rows = t.exec_params(sql, id);
      if (rows.empty()) return std::nullopt;
      return rows[0][0].as<std::string>();
    });
  }

  std::size_t count_where(const char* sql, const std::string& value) {
    return transact([&](pqxx::work& t) { return t.exec_params1(sql, value)[0].as<std::size_t>(); });
  }

  const std::string uri_;
  const PostgresSettings settings_;
  std::mutex mutex_;
  std::unique_ptr<pqxx::connection> connection_;
};

}  // namespace

std::unique_ptr<Store> open_postgres_store(const std::string& uri, const PostgresSettings& settings) {
  return std::make_unique<PostgresStore>(uri, settings);
}

}  // namespace lather::server
