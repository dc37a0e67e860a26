#pragma once
// How values, places and severity are put into words, the same in every report.
#include <string>
#include <vector>

#include "diff/diff_result.h"

namespace skylapse::diff {

/// "94.1 %", "0.31 deg", "3 code values": three digits; "not a number", "infinite".
std::string value_text(double value, const std::string& unit);

/// "at (180, 40), sun's disc, az 182.4, el 40.1, channel R": what is known of it.
std::string place_text(const Place& place);

/// printable() without line ends and tabs: nothing that could break a line or a column.
std::string one_line(const std::string& text);

/// How far a value is beyond its limit, 1 at the limit: of the failing one, else of the warning
/// one. 0 without limits; infinite for NaN, and for what is beyond a limit of 0.
double limit_ratio(const MeasuredValue& measure);

/// The measure nearest to its limit or farthest beyond it; worse verdicts first. Null: none has
/// one.
const MeasuredValue* worst_measure(const std::vector<MeasuredValue>& measures);

/// summary_line without verdict and name: what is worst, where in the sky, by how much.
std::string summary_text(const PairResult& pair);

/// Findings that no measure of the pair stands behind: NaN, size, metadata.
std::vector<const Finding*> structural_findings(const PairResult& pair);

/// Fitted displacements beyond a limit, the most telling first: of the picture, of the sun.
std::vector<const MeasuredValue*> displacements(const PairResult& pair);

/// What a pair stands or falls by: a check, or the measure that says most.
struct Headline {
  std::string check;  // empty: nothing was measured
  double ratio = 0;   // value over limit, of measures; 0: a check without a number
  std::optional<Place> place;
};
Headline headline_of(const PairResult& pair);

/// Numbers of the pairs, the worst first: unreadable, structural findings, displaced, by ratio.
std::vector<size_t> worst_first(const std::vector<PairResult>& pairs);

/// How many pairs have a verdict; those that could not be read count on their own.
struct Counts {
  size_t same = 0, warning = 0, different = 0, unreadable = 0;
};
Counts counts_of(const DiffResult& result);

/// Exit code of the command line: 4 if something could not be read, else that of the verdict.
int exit_code_of(const DiffResult& result);

}  // namespace skylapse::diff
