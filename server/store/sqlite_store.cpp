#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <iterator>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "server/store/store.h"

namespace lather::server {
namespace {

/// Step i leads from version i to the next; a new database takes them all.
constexpr const char* kSchemaSteps[] = {R"sql(
CREATE TABLE schema (version INTEGER NOT NULL);
INSERT INTO schema VALUES (1);
CREATE TABLE jobs (
  sequence INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE,
  name TEXT NOT NULL,
  state TEXT NOT NULL,
  priority INTEGER NOT NULL,
  created INTEGER NOT NULL,
  started INTEGER NOT NULL,
  ended INTEGER NOT NULL,
  attempt INTEGER NOT NULL,
  error TEXT NOT NULL,
  points INTEGER NOT NULL,
  frame_rate REAL NOT NULL,
  frame INTEGER NOT NULL,
  frames INTEGER NOT NULL,
  time REAL NOT NULL,
  fraction REAL NOT NULL,
  step INTEGER NOT NULL,
  seconds_per_frame REAL NOT NULL,
  eta_seconds REAL NOT NULL,
  idempotency_key TEXT UNIQUE,
  request_digest TEXT NOT NULL,
  scene TEXT NOT NULL,
  plan TEXT NOT NULL);
CREATE INDEX jobs_by_state ON jobs (state, priority DESC, sequence);
CREATE TABLE frames (
  job TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  number INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  size INTEGER NOT NULL,
  attempt INTEGER NOT NULL,
  PRIMARY KEY (job, number)) WITHOUT ROWID;
)sql",
                                        R"sql(
ALTER TABLE jobs ADD COLUMN losses INTEGER NOT NULL DEFAULT 0;
CREATE TABLE checkpoints (
  job TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  attempt INTEGER NOT NULL,
  step INTEGER NOT NULL,
  time REAL NOT NULL,
  size INTEGER NOT NULL,
  PRIMARY KEY (job, attempt, step)) WITHOUT ROWID;
UPDATE schema SET version = 2;
)sql"};
constexpr int kSchemaVersion = std::size(kSchemaSteps);

/// The order in which read_job() takes them.
constexpr const char* kJobColumns =
    "id, name, state, priority, created, started, ended, attempt, error, points, frame_rate, frame, frames, "
    "time, "
    "fraction, step, seconds_per_frame, eta_seconds, coalesce(idempotency_key, ''), request_digest, losses, "
    "coalesce((SELECT c.time FROM checkpoints c WHERE c.job = jobs.id"
    " ORDER BY c.attempt DESC, c.step DESC LIMIT 1), -1), sequence";

constexpr int kSequenceColumn = 22;

constexpr const char* kServerEnded = "the server ended while it was at work";

Job read_job(SQLite::Statement& row) {
  Job job;
  int i = 0;
  job.id = row.getColumn(i++).getString();
  job.name = row.getColumn(i++).getString();
  job.state = job_state_from_string(row.getColumn(i++).getString());
  job.priority = row.getColumn(i++).getInt();
  job.created = row.getColumn(i++).getInt64();
  job.started = row.getColumn(i++).getInt64();
  job.ended = row.getColumn(i++).getInt64();
  job.attempt = row.getColumn(i++).getInt();
  job.error = row.getColumn(i++).getString();
  job.points = static_cast<std::uint64_t>(row.getColumn(i++).getInt64());
  job.frame_rate = row.getColumn(i++).getDouble();
  job.progress.frame = row.getColumn(i++).getInt();
  job.progress.frames = row.getColumn(i++).getInt();
  job.progress.time = row.getColumn(i++).getDouble();
  job.progress.fraction = row.getColumn(i++).getDouble();
  job.progress.step = static_cast<std::uint64_t>(row.getColumn(i++).getInt64());
  job.progress.seconds_per_frame = row.getColumn(i++).getDouble();
  job.progress.eta_seconds = row.getColumn(i++).getDouble();
  job.idempotency_key = row.getColumn(i++).getString();
  job.request_digest = row.getColumn(i++).getString();
  job.losses = row.getColumn(i++).getInt();
  job.checkpoint_time = row.getColumn(i++).getDouble();
  return job;
}

FrameRow read_frame(SQLite::Statement& row) {
  FrameRow frame;
  frame.index = row.getColumn(0).getInt();
  frame.sha256 = row.getColumn(1).getString();
  frame.size = static_cast<std::uint64_t>(row.getColumn(2).getInt64());
  frame.attempt = row.getColumn(3).getInt();
  return frame;
}

class SqliteStore final : public Store {
 public:
  explicit SqliteStore(std::filesystem::path file) : file_(std::move(file)) { const Access access(*this); }

  std::optional<Job> add(const Submission& submission) override {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    const Job& job = submission.job;
    if (!job.idempotency_key.empty()) {
      std::optional<Job> earlier = find_where("idempotency_key = ?", job.idempotency_key);
      if (earlier) return earlier;
    }
    insert(submission);
    transaction.commit();
    return std::nullopt;
  }

  std::optional<Job> find(const std::string& id) override {
    const Access access(*this);
    return find_where("id = ?", id);
  }

  std::optional<std::string> plan(const std::string& id) override { return document("plan", id); }
  std::optional<std::string> scene(const std::string& id) override { return document("scene", id); }

  JobPage list(const Listing& listing) override {
    const std::int64_t before = listing.cursor.empty() ? INT64_MAX : sequence_of_cursor(listing.cursor);
    const std::string only = listing.state ? to_string(*listing.state) : "";
    const Access access(*this);
    SQLite::Statement query(*database_, std::string("SELECT ") + kJobColumns +
                                            " FROM jobs WHERE sequence < ? AND (? = '' OR state = ?)"
                                            " ORDER BY sequence DESC LIMIT ?");
    query.bind(1, before);
    query.bind(2, only);
    query.bind(3, only);
    query.bind(4, static_cast<std::int64_t>(listing.limit) + 1);
    JobPage page;
    std::int64_t last = 0;
    while (query.executeStep()) {
      if (page.jobs.size() == listing.limit) {
        page.next_cursor = std::to_string(last);
        break;
      }
      page.jobs.push_back(read_job(query));
      last = query.getColumn(kSequenceColumn).getInt64();
    }
    return page;
  }

  std::size_t count(JobState state) override {
    return count_where("SELECT count(*) FROM jobs WHERE state = ?", to_string(state));
  }

  std::optional<Job> lease() override {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    SQLite::Statement first(
        *database_, "SELECT id FROM jobs WHERE state = 'queued' ORDER BY priority DESC, sequence LIMIT 1");
    if (!first.executeStep()) return std::nullopt;
    const std::string id = first.getColumn(0).getString();
    SQLite::Statement update(
        *database_,
        "UPDATE jobs SET state = 'running', attempt = attempt + 1, started = ?, ended = 0, "
        "eta_seconds = -1 WHERE id = ?");
    update.bind(1, now_ms());
    update.bind(2, id);
    update.exec();
    std::optional<Job> job = find_where("id = ?", id);
    transaction.commit();
    return job;
  }

  std::optional<JobState> heartbeat(const std::string& id, int attempt) override {
    const std::optional<Job> job = find(id);
    if (!job || job->attempt != attempt) return std::nullopt;
    return is_at_work(job->state) ? std::optional(job->state) : std::nullopt;
  }

  std::size_t reclaim() override { return 0; }

  bool move(const std::string& id, JobState to, const std::string& error) override {
    return move_if(id, std::nullopt, to, error);
  }
  bool settle(const std::string& id, int attempt, JobState to, const std::string& error) override {
    return move_if(id, attempt, to, error);
  }

  std::optional<JobState> lose(const std::string& id, int attempt, const std::string& why) override {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    const std::optional<Job> job = find_where("id = ?", id);
    if (!job || job->attempt != attempt || !is_at_work(job->state)) return std::nullopt;
    const JobState next = lose(*job, why);
    transaction.commit();
    return next;
  }

  bool requeue(const std::string& id, JobState from) override { return requeue_with(id, from, nullptr); }
  bool extend(const std::string& id, const LongerRun& longer) override {
    return requeue_with(id, JobState::kSucceeded, &longer);
  }

  bool set_priority(const std::string& id, int priority) override {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    const std::optional<Job> job = find_where("id = ?", id);
    if (!job || has_ended(job->state)) return false;
    SQLite::Statement update(*database_, "UPDATE jobs SET priority = ? WHERE id = ?");
    update.bind(1, priority);
    update.bind(2, id);
    update.exec();
    transaction.commit();
    return true;
  }

  bool set_progress(const std::string& id, int attempt, const JobProgress& progress) override {
    const Access access(*this);
    SQLite::Statement update(
        *database_,
        "UPDATE jobs SET frame = ?, frames = ?, time = ?, fraction = ?, step = ?, "
        "seconds_per_frame = ?, eta_seconds = ? WHERE id = ? AND attempt = ? AND state IN "
        "('running', 'pausing')");
    update.bind(1, progress.frame);
    update.bind(2, progress.frames);
    update.bind(3, progress.time);
    update.bind(4, progress.fraction);
    update.bind(5, static_cast<std::int64_t>(progress.step));
    update.bind(6, progress.seconds_per_frame);
    update.bind(7, progress.eta_seconds);
    update.bind(8, id);
    update.bind(9, attempt);
    return update.exec() == 1;
  }

  bool publish(const std::string& id, int attempt, const FrameRow& frame) override {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    const std::optional<Job> job = find_where("id = ?", id);
    if (!job || job->attempt != attempt || !attempt_stands(job->state)) return false;
    SQLite::Statement insert_frame(
        *database_,
        "INSERT OR REPLACE INTO frames (job, number, sha256, size, attempt) VALUES (?, ?, ?, ?, ?)");
    insert_frame.bind(1, id);
    insert_frame.bind(2, frame.index);
    insert_frame.bind(3, frame.sha256);
    insert_frame.bind(4, static_cast<std::int64_t>(frame.size));
    insert_frame.bind(5, attempt);
    insert_frame.exec();
    transaction.commit();
    return true;
  }

  bool add_checkpoint(const std::string& id, const CheckpointRow& checkpoint) override {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    const std::optional<Job> job = find_where("id = ?", id);
    if (!job || job->attempt != checkpoint.attempt || !attempt_stands(job->state)) return false;
    SQLite::Statement row(
        *database_,
        "INSERT OR REPLACE INTO checkpoints (job, attempt, step, time, size) VALUES (?, ?, ?, ?, ?)");
    row.bind(1, id);
    row.bind(2, checkpoint.attempt);
    row.bind(3, static_cast<std::int64_t>(checkpoint.step));
    row.bind(4, checkpoint.time);
    row.bind(5, static_cast<std::int64_t>(checkpoint.size));
    row.exec();
    SQLite::Statement forget(*database_, "UPDATE jobs SET losses = 0 WHERE id = ?");
    forget.bind(1, id);
    forget.exec();
    transaction.commit();
    return true;
  }

  std::vector<CheckpointRow> checkpoints(const std::string& id) override {
    const Access access(*this);
    return checkpoints_of(id);
  }

  std::vector<CheckpointRow> drop_checkpoints(const std::string& id, std::size_t keep) override {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    std::vector<CheckpointRow> rows = checkpoints_of(id);
    rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(std::min(keep, rows.size())));
    for (const CheckpointRow& row : rows) {
      SQLite::Statement removal(*database_,
                                "DELETE FROM checkpoints WHERE job = ? AND attempt = ? AND step = ?");
      removal.bind(1, id);
      removal.bind(2, row.attempt);
      removal.bind(3, static_cast<std::int64_t>(row.step));
      removal.exec();
    }
    transaction.commit();
    return rows;
  }

  using Store::frames;
  std::vector<FrameRow> frames(const std::string& id, int first) override {
    const Access access(*this);
    SQLite::Statement query(*database_,
                            "SELECT number, sha256, size, attempt FROM frames WHERE job = ? AND number >= ?"
                            " ORDER BY number");
    query.bind(1, id);
    query.bind(2, first);
    std::vector<FrameRow> rows;
    while (query.executeStep()) rows.push_back(read_frame(query));
    return rows;
  }

  std::optional<FrameRow> frame(const std::string& id, int index) override {
    const Access access(*this);
    SQLite::Statement query(*database_,
                            "SELECT number, sha256, size, attempt FROM frames WHERE job = ? AND number = ?");
    query.bind(1, id);
    query.bind(2, index);
    if (!query.executeStep()) return std::nullopt;
    return read_frame(query);
  }

  std::size_t count_frames(const std::string& id) override {
    return count_where("SELECT count(*) FROM frames WHERE job = ?", id);
  }

  bool remove(const std::string& id) override {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    const std::optional<Job> job = find_where("id = ?", id);
    if (!job || !has_ended(job->state)) return false;
    SQLite::Statement removal(*database_, "DELETE FROM jobs WHERE id = ?");
    removal.bind(1, id);
    removal.exec();
    transaction.commit();
    return true;
  }

  std::size_t recover() override {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    std::vector<Job> lost;
    SQLite::Statement query(*database_, std::string("SELECT ") + kJobColumns +
                                            " FROM jobs WHERE state IN ('running', 'pausing', 'cancelling')");
    while (query.executeStep()) lost.push_back(read_job(query));
    for (const Job& job : lost) lose(job, kServerEnded);
    transaction.commit();
    return lost.size();
  }

 private:
  /// Holds the connection for one call. A call that throws leaves it closed: after a write or a sync that
  /// failed nobody knows what the kernel still holds of the file, so the next call opens it anew.
  class Access {
   public:
    explicit Access(SqliteStore& store) : lock_(store.mutex_), store_(store) {
      if (!store_.database_) store_.open();
    }
    ~Access() {
      if (std::uncaught_exceptions() > exceptions_) store_.database_.reset();
    }
    Access(const Access&) = delete;
    Access& operator=(const Access&) = delete;

   private:
    const std::lock_guard<std::mutex> lock_;
    SqliteStore& store_;
    const int exceptions_ = std::uncaught_exceptions();
  };

  void open() {
    auto database = std::make_unique<SQLite::Database>(
        file_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE | SQLite::OPEN_FULLMUTEX);
    database->exec("PRAGMA journal_mode=WAL");
    database->exec("PRAGMA synchronous=FULL");
    database->exec("PRAGMA foreign_keys=ON");
    const int version =
        database->tableExists("schema") ? database->execAndGet("SELECT version FROM schema").getInt() : 0;
    if (version > kSchemaVersion)
      throw std::runtime_error(file_.string() + " has schema version " + std::to_string(version) +
                               ", this build reads up to version " + std::to_string(kSchemaVersion));
    if (version < kSchemaVersion) {
      SQLite::Transaction transaction(*database);
      for (int step = version; step < kSchemaVersion; ++step) database->exec(kSchemaSteps[step]);
      transaction.commit();
    }
    database_ = std::move(database);
  }

  bool move_if(const std::string& id, std::optional<int> attempt, JobState to, const std::string& error) {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    const std::optional<Job> job = find_where("id = ?", id);
    if (!job || !can_move(job->state, to) || (attempt && job->attempt != *attempt)) return false;
    write_state(id, to, to == JobState::kFailed ? error : job->error, job->losses);
    transaction.commit();
    return true;
  }

  // The next ones run within a transaction of their caller.
  void write_state(const std::string& id, JobState to, const std::string& error, int losses) {
    SQLite::Statement update(*database_,
                             "UPDATE jobs SET state = ?, error = ?, ended = ?, losses = ? WHERE id = ?");
    update.bind(1, to_string(to));
    update.bind(2, error);
    update.bind(3, has_ended(to) ? now_ms() : 0);
    update.bind(4, losses);
    update.bind(5, id);
    update.exec();
  }

  JobState lose(const Job& job, const std::string& why) {
    const int losses = job.losses + 1;
    const JobState next = after_loss(job.state, losses);
    write_state(job.id, next, next == JobState::kFailed ? lost_too_often(why) : job.error, losses);
    return next;
  }

  bool requeue_with(const std::string& id, JobState from, const LongerRun* longer) {
    const Access access(*this);
    SQLite::Transaction transaction(*database_);
    const std::optional<Job> job = find_where("id = ?", id);
    if (!job || job->state != from || !can_move(from, JobState::kQueued)) return false;
    write_state(id, JobState::kQueued, "", 0);
    if (longer) {
      SQLite::Statement update(*database_,
                               "UPDATE jobs SET scene = ?, plan = ?, frames = ?, points = ?, fraction = "
                               "fraction * frames / max(1, ?) WHERE id = ?");
      update.bind(1, longer->scene);
      update.bind(2, longer->plan);
      update.bind(3, longer->frames);
      update.bind(4, static_cast<std::int64_t>(longer->points));
      update.bind(5, longer->frames);
      update.bind(6, id);
      update.exec();
    }
    transaction.commit();
    return true;
  }

  std::vector<CheckpointRow> checkpoints_of(const std::string& id) {
    SQLite::Statement query(*database_,
                            "SELECT attempt, step, time, size FROM checkpoints WHERE job = ?"
                            " ORDER BY attempt DESC, step DESC");
    query.bind(1, id);
    std::vector<CheckpointRow> rows;
    while (query.executeStep())
      rows.push_back({query.getColumn(0).getInt(), static_cast<std::uint64_t>(query.getColumn(1).getInt64()),
                      query.getColumn(2).getDouble(),
                      static_cast<std::uint64_t>(query.getColumn(3).getInt64())});
    return rows;
  }

  void insert(const Submission& submission) {
    const Job& job = submission.job;
    SQLite::Statement row(
        *database_,
        "INSERT INTO jobs (id, name, state, priority, created, started, ended, attempt, error, "
        "points, frame_rate, frame, frames, time, fraction, step, seconds_per_frame, eta_seconds, "
        "idempotency_key, request_digest, scene, plan) VALUES (?, ?, 'queued', ?, ?, 0, 0, 0, "
        "'', ?, ?, 0, ?, 0, 0, 0, 0, -1, nullif(?, ''), ?, ?, ?)");
    row.bind(1, job.id);
    row.bind(2, job.name);
    row.bind(3, job.priority);
    row.bind(4, job.created);
    row.bind(5, static_cast<std::int64_t>(job.points));
    row.bind(6, job.frame_rate);
    row.bind(7, job.progress.frames);
    row.bind(8, job.idempotency_key);
    row.bind(9, job.request_digest);
    row.bind(10, submission.scene);
    row.bind(11, submission.plan);
    row.exec();
  }

  std::optional<Job> find_where(const char* condition, const std::string& value) {
    SQLite::Statement query(*database_,
                            std::string("SELECT ") + kJobColumns + " FROM jobs WHERE " + condition);
    query.bind(1, value);
    if (!query.executeStep()) return std::nullopt;
    return read_job(query);
  }

  std::optional<std::string> document(const char* column, const std::string& id) {
    const Access access(*this);
    SQLite::Statement query(*database_, std::string("SELECT ") + column + " FROM jobs WHERE id = ?");
    query.bind(1, id);
    if (!query.executeStep()) return std::nullopt;
    return query.getColumn(0).getString();
  }

  std::size_t count_where(const char* sql, const std::string& value) {
    const Access access(*this);
    SQLite::Statement query(*database_, sql);
    query.bind(1, value);
    query.executeStep();
    return static_cast<std::size_t>(query.getColumn(0).getInt64());
  }

  const std::filesystem::path file_;
  std::mutex mutex_;
  std::unique_ptr<SQLite::Database> database_;  // null: to be opened by the next call
};

}  // namespace

std::unique_ptr<Store> open_sqlite_store(const std::filesystem::path& file) {
  return std::make_unique<SqliteStore>(file);
}

}  // namespace lather::server
