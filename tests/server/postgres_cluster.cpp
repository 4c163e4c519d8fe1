#include "tests/server/postgres_cluster.h"

#include <fcntl.h>
#include <pwd.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "tests/server/eventually.h"

namespace lather::server {
namespace {

const std::string kPrograms = std::string(LATHER_POSTGRES_PROGRAMS) + "/";

/// PostgreSQL refuses to run as root; what is set here makes it the user postgres, and end with this process.
std::vector<std::string> as_its_user() {
  std::vector<std::string> words = {"setpriv", "--pdeathsig", "QUIT"};
  if (::geteuid() == 0) {
    words.insert(words.end(), {"--reuid=postgres", "--regid=postgres", "--clear-groups"});
  }
  return words;
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += word + ' ';
  return line;
}

void give_to_its_user(const std::filesystem::path& directory) {
  if (::geteuid() != 0) return;
  const passwd* const user = ::getpwnam("postgres");
  if (user == nullptr || ::chown(directory.c_str(), user->pw_uid, user->pw_gid) != 0)
    throw std::runtime_error("cannot give " + directory.string() + " to the user postgres");
}

}  // namespace

PostgresCluster::PostgresCluster() {
  give_to_its_user(directory_.path());
  if (!run("initdb", "--no-sync --auth=trust --username=postgres --encoding=UTF8 --locale=C -D " +
                         (directory_.path() / "data").string()))
    throw std::runtime_error("initdb failed");
  start();
}

PostgresCluster::~PostgresCluster() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGQUIT);
  ::waitpid(pid_, nullptr, 0);
}

std::string PostgresCluster::new_database() {
  const std::string name = "test" + std::to_string(++databases_);
  const std::string here = "-h " + directory_.path().string() + " -U postgres ";
  if (!run("createdb", here + name)) throw std::runtime_error("createdb failed");
  return "postgresql:///" + name + "?user=postgres&host=" + directory_.path().string();
}

void PostgresCluster::drop_connections() const {
  if (!run("psql", "-q -U postgres -h " + directory_.path().string() +
                       " -c \"SELECT pg_terminate_backend(pid) FROM pg_stat_activity"
                       " WHERE datname LIKE 'test%'\""))
    throw std::runtime_error("psql failed");
}

bool PostgresCluster::run(const std::string& program, const std::string& arguments) const {
  const std::string line = "cd / && " + joined(as_its_user()) + kPrograms + program + ' ' + arguments +
                           " >> " + (directory_.path() / "log").string() + " 2>&1";
  return std::system(line.c_str()) == 0;
}

void PostgresCluster::start() {
  std::vector<std::string> words = as_its_user();
  for (const std::string& word :
       {kPrograms + "postgres", std::string("-D"), (directory_.path() / "data").string(), std::string("-k"),
        directory_.path().string(), std::string("-h"), std::string(), std::string("-F")})
    words.push_back(word);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string log = (directory_.path() / "log").string();
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  ::posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  const int error = ::posix_spawnp(&pid_, "setpriv", &files, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  if (error != 0) pid_ = -1;
  const bool ready =
      error == 0 && eventually([this] { return run("pg_isready", "-q -h " + directory_.path().string()); },
                               std::chrono::seconds(60));
  if (ready) return;
  std::ifstream words_of_error(log);
  throw std::runtime_error("PostgreSQL did not start: " +
                           std::string(std::istreambuf_iterator<char>(words_of_error), {}));
}

}  // namespace lather::server
