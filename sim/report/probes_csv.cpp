#include "sim/report/report.h"
#include "sim/scene/value.h"

namespace lather {
namespace {

/// A field of CSV (RFC 4180), in quotes where it needs them.
std::string csv_field(const std::string& text) {
  if (text.find_first_of("\",\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::string probes_csv(const std::vector<ProbeSeries>& probes) {
  std::string out = "probe,quantity,unit,time,value\n";
  for (const ProbeSeries& p : probes)
    for (std::size_t c = 0; c < p.columns.size(); ++c) {
      const std::string head =
          csv_field(p.name) + ',' + p.columns[c].quantity + ',' + p.columns[c].unit + ',';
      for (std::size_t i = 0; i < p.times.size(); ++i)
        out.append(head)
            .append(write_json(Value(p.times[i])))
            .append(",")
            .append(write_json(Value(p.values[i * p.columns.size() + c])))
            .append("\n");
    }
  return out;
}

}  // namespace lather
