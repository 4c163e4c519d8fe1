#include <SQLiteCpp/SQLiteCpp.h>

#include <mutex>
#include <stdexcept>

#include "server/store/store.h"

namespace lather::server {
namespace {

constexpr int kSchemaVersion = 1;

constexpr const char* kSchema = R"sql(
CREATE TABLE schema (version INTEGER NOT NULL);
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
)sql";

/// The order in which read_job() takes them.
constexpr const char* kJobColumns =
    "id, name, state, priority, created, started, ended, attempt, error, points, frame_rate, frame, frames, "
    "time, "
    "fraction, step, seconds_per_frame, eta_seconds, coalesce(idempotency_key, ''), request_digest, sequence";

constexpr int kSequenceColumn = 20;

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
  explicit SqliteStore(const std::filesystem::path& file)
      : database_(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE | SQLite::OPEN_FULLMUTEX) {
    database_.exec("PRAGMA journal_mode=WAL");
    database_.exec("PRAGMA synchronous=FULL");
    database_.exec("PRAGMA foreign_keys=ON");
    if (!database_.tableExists("schema")) create_schema();
    const int version = database_.execAndGet("SELECT version FROM schema").getInt();
    if (version != kSchemaVersion)
      throw std::runtime_error(file.string() + " has schema version " + std::to_string(version) +
                               ", this build reads version " + std::to_string(kSchemaVersion));
  }

  std::optional<Job> add(const Submission& submission) override {
    const std::lock_guard lock(mutex_);
    SQLite::Transaction transaction(database_);
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
    const std::lock_guard lock(mutex_);
    return find_where("id = ?", id);
  }

  std::optional<std::string> plan(const std::string& id) override { return document("plan", id); }
  std::optional<std::string> scene(const std::string& id) override { return document("scene", id); }

  JobPage list(const Listing& listing) override {
    const std::int64_t before = listing.cursor.empty() ? INT64_MAX : sequence_of_cursor(listing.cursor);
    const std::string only = listing.state ? to_string(*listing.state) : "";
    const std::lock_guard lock(mutex_);
    SQLite::Statement query(database_, std::string("SELECT ") + kJobColumns +
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
    const std::lock_guard lock(mutex_);
    SQLite::Transaction transaction(database_);
    SQLite::Statement first(
        database_, "SELECT id FROM jobs WHERE state = 'queued' ORDER BY priority DESC, sequence LIMIT 1");
    if (!first.executeStep()) return std::nullopt;
    const std::string id = first.getColumn(0).getString();
    SQLite::Statement update(
        database_,
        "UPDATE jobs SET state = 'running', attempt = attempt + 1, started = ?, ended = 0, "
        "frame = 0, time = 0, fraction = 0, step = 0, eta_seconds = -1 WHERE id = ?");
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
    const bool at_work = job->state == JobState::kRunning || job->state == JobState::kCancelling;
    return at_work ? std::optional(job->state) : std::nullopt;
  }

  std::size_t reclaim() override { return 0; }

  bool move(const std::string& id, JobState to, const std::string& error) override {
    return move_if(id, std::nullopt, to, error);
  }
  bool settle(const std::string& id, int attempt, JobState to, const std::string& error) override {
    return move_if(id, attempt, to, error);
  }

  bool set_progress(const std::string& id, int attempt, const JobProgress& progress) override {
    const std::lock_guard lock(mutex_);
    SQLite::Statement update(
        database_,
        "UPDATE jobs SET frame = ?, frames = ?, time = ?, fraction = ?, step = ?, "
        "seconds_per_frame = ?, eta_seconds = ? WHERE id = ? AND attempt = ? AND state = "
        "'running'");
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
    const std::lock_guard lock(mutex_);
    SQLite::Transaction transaction(database_);
    const std::optional<Job> job = find_where("id = ?", id);
    if (!job || job->attempt != attempt || !attempt_stands(job->state)) return false;
    SQLite::Statement insert_frame(
        database_,
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

  std::vector<FrameRow> frames(const std::string& id) override {
    const std::lock_guard lock(mutex_);
    SQLite::Statement query(database_,
                            "SELECT number, sha256, size, attempt FROM frames WHERE job = ? ORDER BY number");
    query.bind(1, id);
    std::vector<FrameRow> rows;
    while (query.executeStep()) rows.push_back(read_frame(query));
    return rows;
  }

  std::optional<FrameRow> frame(const std::string& id, int index) override {
    const std::lock_guard lock(mutex_);
    SQLite::Statement query(database_,
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
    const std::lock_guard lock(mutex_);
    SQLite::Transaction transaction(database_);
    const std::optional<Job> job = find_where("id = ?", id);
    if (!job || !has_ended(job->state)) return false;
    SQLite::Statement removal(database_, "DELETE FROM jobs WHERE id = ?");
    removal.bind(1, id);
    removal.exec();
    transaction.commit();
    return true;
  }

  std::size_t recover() override {
    const std::lock_guard lock(mutex_);
    SQLite::Transaction transaction(database_);
    const int queued = database_.exec("UPDATE jobs SET state = 'queued' WHERE state = 'running'");
    SQLite::Statement cancel(database_,
                             "UPDATE jobs SET state = 'cancelled', ended = ? WHERE state = 'cancelling'");
    cancel.bind(1, now_ms());
    const int cancelled = cancel.exec();
    transaction.commit();
    return static_cast<std::size_t>(queued) + static_cast<std::size_t>(cancelled);
  }

 private:
  void create_schema() {
    SQLite::Transaction transaction(database_);
    database_.exec(kSchema);
    database_.exec("INSERT INTO schema VALUES (" + std::to_string(kSchemaVersion) + ")");
    transaction.commit();
  }

  bool move_if(const std::string& id, std::optional<int> attempt, JobState to, const std::string& error) {
    const std::lock_guard lock(mutex_);
    SQLite::Transaction transaction(database_);
    const std::optional<Job> job = find_where("id = ?", id);
    if (!job || !can_move(job->state, to) || (attempt && job->attempt != *attempt)) return false;
    SQLite::Statement update(database_, "UPDATE jobs SET state = ?, error = ?, ended = ? WHERE id = ?");
    update.bind(1, to_string(to));
    update.bind(2, to == JobState::kFailed ? error : job->error);
    update.bind(3, has_ended(to) ? now_ms() : 0);
    update.bind(4, id);
    update.exec();
    transaction.commit();
    return true;
  }

  void insert(const Submission& submission) {
    const Job& job = submission.job;
    SQLite::Statement row(
        database_,
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
    SQLite::Statement query(database_,
                            std::string("SELECT ") + kJobColumns + " FROM jobs WHERE " + condition);
    query.bind(1, value);
    if (!query.executeStep()) return std::nullopt;
    return read_job(query);
  }

  std::optional<std::string> document(const char* column, const std::string& id) {
    const std::lock_guard lock(mutex_);
    SQLite::Statement query(database_, std::string("SELECT ") + column + " FROM jobs WHERE id = ?");
    query.bind(1, id);
    if (!query.executeStep()) return std::nullopt;
    return query.getColumn(0).getString();
  }

  std::size_t count_where(const char* sql, const std::string& value) {
    const std::lock_guard lock(mutex_);
    SQLite::Statement query(database_, sql);
    query.bind(1, value);
    query.executeStep();
    return static_cast<std::size_t>(query.getColumn(0).getInt64());
  }

  std::mutex mutex_;
  SQLite::Database database_;
};

}  // namespace

std::unique_ptr<Store> open_sqlite_store(const std::filesystem::path& file) {
  return std::make_unique<SqliteStore>(file);
}

}  // namespace lather::server
