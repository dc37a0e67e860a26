// The JUnit XML that Jenkins (jenkins-junit.xsd) and GitLab read: testsuites, testsuite, testcase
// with at most one of error or failure, then system-out.
#include <fmt/format.h>

#include "core/printable.h"
#include "diff/reports.h"
#include "diff/wording.h"

namespace skylapse::diff {
namespace {

std::string attribute(const std::string& text) { return xml_escaped(one_line(text)); }

std::string finding_text(const Finding& f) {
  std::string text = fmt::format("{}: {}: {}", name_of(f.severity), f.check, f.message);
  if (f.place) text += " " + place_text(*f.place);
  return one_line(text) + "\n";
}

std::string findings_text(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& f : findings) text += finding_text(f);
  return text;
}

std::string details(const PairResult& pair) {
  std::string text = fmt::format("A (reference): {}\nB: {}\nprofile: {}\n", one_line(pair.a.path),
                                 one_line(pair.b.path), one_line(pair.profile));
  if (!pair.golden.empty()) text += "golden of: " + one_line(pair.golden) + "\n";
  for (const Finding* f : structural_findings(pair)) text += finding_text(*f);
  for (const MeasuredValue& m : pair.measures) {
    if (m.verdict == Verdict::same) continue;
    text +=
        one_line(fmt::format("{}: {} {}", name_of(m.verdict), m.name, value_text(m.value, m.unit)));
    text += fmt::format(", {:.3g} times its limit", limit_ratio(m));
    if (m.place) text += ", " + place_text(*m.place);
    text += "\n";
  }
  return text;
}

struct Case {
  std::string name;
  double seconds = 0;
  std::string error, failure, message, text, output;
};

std::string case_xml(const Case& c) {
  std::string xml =
      fmt::format("  <testcase classname=\"skylapse.diff\" name=\"{}\" time=\"{:.3f}\">\n",
                  attribute(c.name), c.seconds);
  for (const auto& [tag, type] : {std::pair("error", c.error), {"failure", c.failure}})
    if (!type.empty())
      xml += fmt::format("   <{0} message=\"{1}\" type=\"{2}\">{3}</{0}>\n", tag,
                         attribute(c.message), attribute(type), xml_escaped(c.text));
  if (!c.output.empty()) xml += "   <system-out>" + xml_escaped(c.output) + "</system-out>\n";
  return xml + "  </testcase>\n";
}

Case case_of(const PairResult& pair) {
  Case c;
  c.name = pair.name;
  c.seconds = 1e-3 * (pair.read_ms + pair.measure_ms + pair.flip_ms);
  c.message = summary_line(pair);
  if (pair.error) {
    c.error = "unreadable", c.message = pair.error->message;
    c.text = one_line(pair.error->message + " " + pair.error->hint) + "\n" + details(pair);
  } else if (pair.verdict == Verdict::different) {
    c.failure = headline_of(pair).check, c.text = details(pair);
    if (c.failure.empty()) c.failure = "different";
  } else {
    c.output = summary_line(pair) + "\n";
    if (pair.verdict == Verdict::warning) c.output += details(pair);
  }
  return c;
}

/// Missing and extra files, order, flicker.
Case case_of_the_whole(const DiffResult& result) {
  Case c;
  c.name = "(all files)";
  size_t failures = 0;
  const Finding* first = nullptr;
  for (const Finding& f : result.findings)
    if (f.severity == Verdict::different && ++failures == 1) first = &f;
  if (first) {
    c.failure = first->check;
    c.message = first->check + ": " + first->message;
    if (failures > 1) c.message += fmt::format(" (+{} more)", failures - 1);
    c.text = findings_text(result.findings);
  } else {
    c.output = findings_text(result.findings);
  }
  return c;
}

}  // namespace

std::string junit_report(const DiffResult& result) {
  std::vector<Case> cases{case_of_the_whole(result)};
  for (const PairResult& pair : result.pairs) cases.push_back(case_of(pair));
  size_t failures = 0, errors = 0;
  std::string body;
  for (const Case& c : cases) {
    failures += !c.failure.empty(), errors += !c.error.empty();
    body += case_xml(c);
  }
  const std::string totals =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\"", cases.size(),
                  failures, errors, result.seconds);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"skylapse diff\" {0}>\n"
      " <testsuite name=\"{1}\" {0} skipped=\"0\">\n{2} </testsuite>\n</testsuites>\n",
      totals, attribute(result.a + " against " + result.b), body);
}

}  // namespace skylapse::diff
