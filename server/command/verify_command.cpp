#include <cstdio>
#include <string>

#include "server/command/commands.h"
#include "server/command/progress_bar.h"
#include "sim/error.h"
#include "sim/scene/descriptor.h"
#include "sim/study/verify/case.h"

namespace lather::server {
namespace {

using study::CaseResult;
using study::VerificationCase;

const VerificationCase& case_named(const std::string& name) {
  std::vector<std::string> names;
  for (const VerificationCase& c : study::verification_cases()) {
    if (c.name == name) return c;
    names.push_back(c.name);
  }
  const std::string near = descriptor::nearest_name(name, names);
  throw InputError(
      {{"", name, descriptor::listed(names),
        "There is no case of that name." + (near.empty() ? "" : " Did you mean \"" + near + "\"?")}});
}

std::vector<const VerificationCase*> chosen(const VerifyOptions& options) {
  std::vector<const VerificationCase*> cases;
  for (const std::string& name : options.cases) cases.push_back(&case_named(name));
  if (!cases.empty()) return cases;
  for (const VerificationCase& c : study::verification_cases())
    if (c.quick || !options.quick) cases.push_back(&c);
  return cases;
}

void print_head() {
  std::printf("%-16s %-70s %10s %10s %7s %9s  %s\n", "case", "error of", "error", "bound", "order", "time",
              "");
}

void print_row(const CaseResult& result) {
  const char* name = result.source->name.c_str();
  const std::string time = duration_text(result.seconds);
  if (!result.error.empty())
    std::printf("%-16s %-70s %10s %10s %7s %9s  FAILED\n", name, result.error.c_str(), "", "", "",
                time.c_str());
  for (std::size_t i = 0; i < result.findings.size(); ++i) {
    const study::Finding& f = result.findings[i];
    char order[16] = "";
    if (f.order) std::snprintf(order, sizeof order, "%.2f", *f.order);
    std::printf("%-16s %-70s %10.3g %10.3g %7s %9s  %s\n", i == 0 ? name : "", f.what.c_str(), f.error,
                f.bound, order, i == 0 ? time.c_str() : "", f.passed() ? "passed" : "FAILED");
  }
  std::fflush(stdout);
}

}  // namespace

int verify_command(const VerifyOptions& options) {
  const std::vector<const VerificationCase*> cases = chosen(options);
  std::vector<CaseResult> results;
  std::size_t failed = 0;
  if (!options.json) print_head();
  for (const VerificationCase* c : cases) {
    results.push_back(study::run_case(*c, options.threads));
    if (!results.back().passed()) ++failed;
    if (!options.json) print_row(results.back());
  }
  if (options.json)
    std::printf("%s\n", study::to_json(results).c_str());
  else
    std::printf("\n%zu of %zu cases passed\n", cases.size() - failed, cases.size());
  return failed == 0 ? 0 : 1;
}

}  // namespace lather::server
