#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "server/artifacts/digest.h"
#include "server/artifacts/lock_file.h"
#include "server/artifacts/safe_read.h"
#include "server/artifacts/whole_file.h"
#include "tests/server/temporary_directory.h"

namespace lather::server {
namespace {

namespace fs = std::filesystem;

class ArtifactsTest : public ::testing::Test {
 protected:
  ArtifactsTest() : root_(directory_.path() / "root") {
    fs::create_directories(root_ / "sub");
    write(root_ / "sub" / "inside.txt", "inside");
    write(directory_.path() / "secret.txt", "secret");
  }
  static void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

  TemporaryDirectory directory_;
  fs::path root_;
};

TEST_F(ArtifactsTest, ReadsAFileBeneathItsRoot) {
  EXPECT_EQ(read_beneath(root_, "sub/inside.txt"), "inside");
  EXPECT_TRUE(open_beneath_stepwise(root_, "sub/inside.txt"));
  EXPECT_FALSE(read_beneath(root_, "sub/inside.txt", 3)) << "larger than the limit";
}

TEST_F(ArtifactsTest, NoPathLeadsOutOfTheRootNorOverALink) {
  fs::create_symlink(directory_.path() / "secret.txt", root_ / "link.txt");
  fs::create_directory_symlink(directory_.path(), root_ / "linked");
  ASSERT_EQ(::mkfifo((root_ / "pipe").c_str(), 0600), 0);
  const std::vector<std::string> escapes = {"../secret.txt",
                                            "sub/../../secret.txt",
                                            "sub/../sub/inside.txt",
                                            "/etc/passwd",
                                            (directory_.path() / "secret.txt").string(),
                                            "link.txt",
                                            "linked/secret.txt",
                                            "sub//inside.txt",
                                            "./sub/inside.txt",
                                            std::string("sub/inside.txt\0.png", 19),
                                            "sub",
                                            "pipe",
                                            "missing",
                                            ""};
  for (const std::string& escape : escapes) {
    EXPECT_FALSE(open_beneath(root_, escape)) << escape;
    EXPECT_FALSE(open_beneath_stepwise(root_, escape)) << escape;
  }
}

TEST_F(ArtifactsTest, AFileIsReplacedWholeAndLeavesNoPart) {
  const fs::path file = root_ / "frame.png";
  write_whole(file, "old");
  write_whole(file, std::string("new\0bytes", 9));
  EXPECT_EQ(read_beneath(root_, "frame.png"), std::string("new\0bytes", 9));
  EXPECT_FALSE(fs::exists(root_ / "frame.png.part"));
  EXPECT_THROW(write_whole(root_ / "no" / "such" / "directory.png", "x"), std::system_error);
}

TEST_F(ArtifactsTest, SweepsPartsAndNothingElse) {
  write(root_ / "sub" / "00001.png.part", "half");
  write(root_ / "00002.png.part", "half");
  EXPECT_EQ(sweep_parts(root_), 2u);
  EXPECT_EQ(read_beneath(root_, "sub/inside.txt"), "inside");
  EXPECT_EQ(sweep_parts(root_), 0u);
}

TEST_F(ArtifactsTest, ATreeIsRemovedWhileAnotherThreadRemovesFilesOfIt) {
  const fs::path tree = root_ / "tree";
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 100; ++i) write(tree / "frames" / (std::to_string(i) + ".png"), "x");
    std::thread other([&] {
      std::error_code ignored;
      for (int i = 0; i < 100; ++i) fs::remove(tree / "frames" / (std::to_string(i) + ".png"), ignored);
    });
    EXPECT_TRUE(remove_tree(tree));
    EXPECT_FALSE(fs::exists(tree));
    other.join();
  }
  EXPECT_TRUE(remove_tree(tree)) << "nothing is left of what is not there";
}

TEST_F(ArtifactsTest, ASecondLockOnADirectoryIsRefusedWhileTheFirstLives) {
  {
    const LockFile first(root_);
    EXPECT_THROW(LockFile second(root_), std::runtime_error);
  }
  EXPECT_NO_THROW(LockFile third(root_));
}

TEST(Digest, IsSha256) {
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace
}  // namespace lather::server
