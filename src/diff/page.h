#pragma once
// The page of --html: one file, no network, with the pixels of the worst pairs in it.
#include <functional>
#include <string>

#include "diff/evidence.h"
#include "diff/reports.h"

namespace skylapse::diff {

/// Gives the pictures of a pair; called from several threads at once.
using EvidenceSource = std::function<Result<PairEvidence>(const PairResult&)>;

/// The whole page. Pairs come the worst first; those without evidence say why.
std::string page_of(const DiffResult& result, const EvidenceSource& evidence,
                    const PageOptions& options);

}  // namespace skylapse::diff
