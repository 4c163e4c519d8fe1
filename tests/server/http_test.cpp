#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/agent/protocol.h"
#include "server/http/access.h"
#include "server/http/byte_range.h"
#include "server/http/problem.h"
#include "server/http/request_head.h"
#include "server/http/router.h"
#include "server/http/zip_stream.h"

namespace lather::server {
namespace {

struct RefusedHead {
  const char* claim;
  std::string head;
  int status;
};
void PrintTo(const RefusedHead& refused, std::ostream* out) {
  *out << refused.claim;
}

class RequestHeadRefusal : public ::testing::TestWithParam<RefusedHead> {};

TEST_P(RequestHeadRefusal, IsRefusedWithItsStatus) {
  const auto outcome = read_request_head(GetParam().head, RequestLimits{});
  ASSERT_TRUE(std::holds_alternative<Refusal>(outcome)) << GetParam().claim;
  EXPECT_EQ(std::get<Refusal>(outcome).status, GetParam().status) << std::get<Refusal>(outcome).detail;
}

std::string get(const std::string& target, const std::string& fields = {}) {
  return "GET " + target + " HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n";
}
std::string post(const std::string& fields) {
  return "POST /x HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n";
}

const std::string kLongPath(600, '/');

INSTANTIATE_TEST_SUITE_P(
    Heads, RequestHeadRefusal,
    ::testing::Values(
        RefusedHead{"LengthAndChunked", post("Content-Length: 3\r\nTransfer-Encoding: chunked\r\n"), 400},
        RefusedHead{"TwoLengths", post("Content-Length: 3\r\nContent-Length: 3\r\n"), 400},
        RefusedHead{"TwoLengthsInOne", post("Content-Length: 3, 3\r\n"), 400},
        RefusedHead{"BodyOnGet", get("/", "Content-Length: 3\r\n"), 400},
        RefusedHead{"Chunked", post("Transfer-Encoding: chunked\r\n"), 411},
        RefusedHead{"NoLength", post(""), 411},
        RefusedHead{"NegativeLength", post("Content-Length: -2\r\n"), 400},
        RefusedHead{"SignedLength", post("Content-Length: +2\r\n"), 400},
        RefusedHead{"HexLength", post("Content-Length: 0x10\r\n"), 400},
        RefusedHead{"HugeLength", post("Content-Length: 99999999999999999999999\r\n"), 413},
        RefusedHead{"LargeLength", post("Content-Length: 100000000\r\n"), 413},
        RefusedHead{"Gzip", post("Content-Length: 3\r\nContent-Encoding: gzip\r\n"), 415},
        RefusedHead{"ManyRanges", get("/", "Range: bytes=0-1,2-3\r\n"), 416},
        RefusedHead{"EncodedLineEnd", get("/", "X: a%0d%0aSet-Cookie: b\r\n"), 400},
        RefusedHead{"NulInValue", get("/", std::string("X: a\0b\r\n", 8)), 400},
        RefusedHead{"BareLineFeed", get("/", "X: a\nY: b\r\n"), 400},
        RefusedHead{"BareCarriageReturn", get("/", "X: a\rY: b\r\n"), 400},
        RefusedHead{"FoldedLine", get("/", "X: a\r\n b\r\n"), 400},
        RefusedHead{"SpaceBeforeColon", get("/", "X : a\r\n"), 400},
        RefusedHead{"TwoHosts", get("/", "Host: evil\r\n"), 400},
        RefusedHead{"NoHost", "GET / HTTP/1.1\r\n\r\n", 400},
        RefusedHead{"NulInPath", get("/a.png%00.html"), 400},
        RefusedHead{"LineEndInPath", get("/a%0d%0ab"), 400}, RefusedHead{"BrokenEscape", get("/a%zz"), 400},
        RefusedHead{"LongPath", get(kLongPath), 414}, RefusedHead{"AbsoluteTarget", get("http://evil/"), 400},
        RefusedHead{"SameParameterTwice", get("/?limit=1&limit=2"), 400},
        RefusedHead{"OtherProtocol", "GET / HTTP/2.0\r\nHost: localhost\r\n\r\n", 505},
        RefusedHead{"NoRequestLine", "\r\nGET / HTTP/1.1\r\n\r\n", 400},
        RefusedHead{"Expectation", post("Content-Length: 3\r\nExpect: tea\r\n"), 417}),
    [](const auto& test) { return test.param.claim; });

TEST(RequestHead, TooManyFieldsAreRefused) {
  std::string fields;
  for (int i = 0; i < 100; ++i) fields += "X: y\r\n";
  const auto outcome = read_request_head(get("/", fields), RequestLimits{});
  ASSERT_TRUE(std::holds_alternative<Refusal>(outcome));
  EXPECT_EQ(std::get<Refusal>(outcome).status, 431);
}

TEST(RequestHead, ReadsPathQueryHeadersAndLength) {
  const auto outcome = read_request_head(
      "POST /api/v1/jobs%2Fx?limit=3&name=a+b%26c HTTP/1.1\r\nHOST: localhost:80\r\nContent-Length: 12\r\n"
      "Accept: a\r\naccept: b\r\nConnection: Close\r\n\r\n",
      RequestLimits{});
  ASSERT_TRUE(std::holds_alternative<RequestHead>(outcome));
  const RequestHead& head = std::get<RequestHead>(outcome);
  EXPECT_EQ(head.request.path, "/api/v1/jobs/x");
  EXPECT_EQ(head.request.parameters.at("limit"), "3");
  EXPECT_EQ(head.request.parameters.at("name"), "a b&c");
  EXPECT_EQ(head.request.header("host"), "localhost:80");
  EXPECT_EQ(head.request.header("accept"), "a, b");
  EXPECT_EQ(head.body_bytes, 12u);
  EXPECT_FALSE(head.request.keep_alive);
}

TEST(Access, OnlyOwnHostsAndOriginsPass) {
  const AccessRules rules({"foam.example"});
  const auto status = [&](const std::string& host, const std::optional<std::string>& origin) {
    HttpRequest request;
    request.headers["host"] = host;
    if (origin) request.headers["origin"] = *origin;
    const std::optional<Refusal> refusal = rules.check(request);
    return refusal ? refusal->status : 200;
  };
  EXPECT_EQ(status("localhost:8080", std::nullopt), 200);
  EXPECT_EQ(status("127.0.0.1:1", "http://127.0.0.1:1"), 200);
  EXPECT_EQ(status("[::1]:8080", "http://[::1]:8080"), 200);
  EXPECT_EQ(status("FOAM.example", std::nullopt), 200);
  EXPECT_EQ(status("127.0.0.1:8080", "https://foam.example"), 200) << "behind a proxy";
  EXPECT_EQ(status("evil.example", std::nullopt), 403);
  EXPECT_EQ(status("localhost.evil.example", std::nullopt), 403);
  EXPECT_EQ(status("127.0.0.1:8080", "null"), 403);
  EXPECT_EQ(status("127.0.0.1:8080", "http://evil.example"), 403);
  EXPECT_EQ(status("127.0.0.1:8080", "http://127.0.0.1:9999"), 403) << "another port is another origin";
}

class RouterTest : public ::testing::Test {
 protected:
  RouterTest() {
    const auto echo = [](const HttpRequest&, const Captures& at) {
      HttpResponse response;
      for (const std::string& capture : at) response.body += capture + ";";
      return response;
    };
    router_.add("GET", "/jobs/{}", echo);
    router_.add("DELETE", "/jobs/{}", echo);
    router_.add("GET", "/jobs/{}/frames/{}.png", echo);
  }
  HttpResponse route(const std::string& method, const std::string& path) {
    HttpRequest request;
    request.method = method;
    request.path = path;
    return router_.route(request);
  }
  int status_of_missing(const std::string& path) {
    try {
      static_cast<void>(route("GET", path));
    } catch (const HttpError& error) {
      return error.status();
    }
    return 0;
  }
  Router router_;
};

TEST_F(RouterTest, FindsHandlersAndCapturesSegments) {
  EXPECT_EQ(route("GET", "/jobs/abc").body, "abc;");
  EXPECT_EQ(route("HEAD", "/jobs/abc").body, "abc;");
  EXPECT_EQ(route("GET", "/jobs/abc/frames/12.png").body, "abc;12;");
}

TEST_F(RouterTest, UnknownPathsAreMissing) {
  for (const char* path :
       {"/", "/jobs", "/jobs/", "/jobs/a/", "/jobs/a/frames/.png", "/jobs/a/frames/1.jpg", "//jobs/a"})
    EXPECT_EQ(status_of_missing(path), 404) << path;
}

TEST_F(RouterTest, OtherMethodsAreRefusedWithThePossibleOnes) {
  const HttpResponse response = route("PUT", "/jobs/abc");
  EXPECT_EQ(response.status, 405);
  ASSERT_EQ(response.headers.size(), 1u);
  EXPECT_EQ(response.headers[0].first, "Allow");
  EXPECT_EQ(response.headers[0].second, "DELETE, GET, HEAD");
}

TEST(ByteRanges, AreReadAsTheStandardSays) {
  const auto part = [](const char* header) {
    const auto range = read_range(header, 100);
    const ByteRange* bytes = std::get_if<ByteRange>(&range);
    return bytes ? std::to_string(bytes->first) + "+" + std::to_string(bytes->size)
                 : std::string(std::holds_alternative<NoRange>(range) ? "all" : "416");
  };
  EXPECT_EQ(part("bytes=0-9"), "0+10");
  EXPECT_EQ(part("bytes=90-"), "90+10");
  EXPECT_EQ(part("bytes=90-999"), "90+10");
  EXPECT_EQ(part("bytes=-10"), "90+10");
  EXPECT_EQ(part("bytes=-999"), "0+100");
  EXPECT_EQ(part("bytes=100-"), "416");
  EXPECT_EQ(part("bytes=-0"), "416");
  EXPECT_EQ(part("bytes=9-1"), "all");
  EXPECT_EQ(part("bytes=a-b"), "all");
  EXPECT_EQ(part("lines=1-2"), "all");
  EXPECT_EQ(part(""), "all");
}

TEST(Zip, HoldsEveryEntryAsItWas) {
  const std::map<std::string, std::string> files = {{"00000.png", std::string(100000, 'a')},
                                                    {"00001.png", std::string("\0\1\2", 3)}};
  std::vector<ZipEntry> entries;
  for (const auto& file : files)
    entries.push_back({file.first, [bytes = file.second] { return std::optional<std::string>(bytes); }});
  std::string zip;
  ASSERT_TRUE(write_zip(entries, [&](std::string_view bytes) {
    zip += bytes;
    return true;
  }));
  const std::unique_ptr<archive, decltype(&archive_read_free)> reader(archive_read_new(), archive_read_free);
  archive_read_support_format_zip_seekable(reader.get());
  ASSERT_EQ(archive_read_open_memory(reader.get(), zip.data(), zip.size()), ARCHIVE_OK);
  std::map<std::string, std::string> found;
  archive_entry* entry = nullptr;
  while (archive_read_next_header(reader.get(), &entry) == ARCHIVE_OK) {
    std::string bytes(static_cast<std::size_t>(archive_entry_size(entry)), '\0');
    ASSERT_EQ(archive_read_data(reader.get(), bytes.data(), bytes.size()),
              static_cast<la_ssize_t>(bytes.size()));
    found[archive_entry_pathname(entry)] = bytes;
  }
  EXPECT_EQ(found, files);
}

TEST(Zip, StopsWhenTheReaderIsGoneOrAFileIsMissing) {
  const ZipEntry there = {"a", [] { return std::optional<std::string>(std::string(100000, 'a')); }};
  const ZipEntry missing = {"b", []() -> std::optional<std::string> { return std::nullopt; }};
  EXPECT_FALSE(write_zip({there}, [](std::string_view) { return false; }));
  EXPECT_FALSE(write_zip({there, missing}, [](std::string_view) { return true; }));
}

TEST(Protocol, EventsReadBackAndOtherLinesAreNone) {
  RunProgress progress;
  progress.frame = 3;
  progress.frames = 9;
  progress.fraction = 0.25;
  progress.step = 123456789012345;
  const auto read = event_from_line(to_line(RunnerEvent(progress)));
  ASSERT_TRUE(read && std::holds_alternative<RunProgress>(*read));
  EXPECT_EQ(std::get<RunProgress>(*read).step, progress.step);
  EXPECT_EQ(std::get<RunProgress>(*read).fraction, 0.25);
  const auto result =
      event_from_line(to_line(RunnerEvent(RunnerResult{"failed", "bytes \xff\n\"quoted\"", "files"})));
  ASSERT_TRUE(result && std::holds_alternative<RunnerResult>(*result));
  EXPECT_EQ(std::get<RunnerResult>(*result).state, "failed");
  EXPECT_EQ(std::get<RunnerResult>(*result).cause, "files");
  const auto checkpoint = event_from_line(to_line(RunnerEvent(CheckpointFile{12345, 0.1, 678})));
  ASSERT_TRUE(checkpoint && std::holds_alternative<CheckpointFile>(*checkpoint));
  EXPECT_EQ(std::get<CheckpointFile>(*checkpoint).step, 12345U);
  EXPECT_EQ(std::get<CheckpointFile>(*checkpoint).time, 0.1);
  for (const char* line :
       {"", "{}", "[]", "{\"event\":\"frame\"}", "{\"event\":\"frame\",\"index\":\"x\"}", "nonsense"})
    EXPECT_FALSE(event_from_line(line)) << line;
}

TEST(Problems, AreDocumentsWithPointerValueAllowedAndMessage) {
  const HttpResponse response =
      HttpError(422, "bad", {{"/spacing", "-1", "above 0", "spacing is negative"}}).response();
  EXPECT_EQ(response.status, 422);
  EXPECT_EQ(response.content_type, "application/problem+json");
  for (const char* part : {"\"/spacing\"", "\"-1\"", "\"above 0\"", "\"spacing is negative\""})
    EXPECT_NE(response.body.find(part), std::string::npos) << part;
  EXPECT_NE(refusal_bytes({400, "bytes \xff"}).find("HTTP/1.1 400 Bad Request\r\n"), std::string::npos);
}

}  // namespace
}  // namespace lather::server
