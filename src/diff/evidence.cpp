#include "diff/evidence.h"

#include <utility>

#include "diff/facts.h"
#include "image/diff/flip.h"
#include "image/diff/measure.h"

namespace skylapse::diff {
namespace {

bool comparable(const image::Picture& a, const image::Picture& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         a.display_referred == b.display_referred;
}

}  // namespace

Result<PairEvidence> read_evidence(const PairResult& pair) {
  auto a = read_picture(pair.a.path, {});
  if (!a) return a.error();
  auto b = read_picture(pair.b.path, {});
  if (!b) return b.error();
  PairEvidence evidence{std::move(a->picture), std::move(b->picture), {}, {}};
  if (!comparable(evidence.a, evidence.b)) return evidence;
  auto comparison = image::compare(evidence.a, evidence.b, pair.view);
  evidence.error = std::move(comparison.error);
  if (comparison.identical)
    evidence.flip.resize(evidence.a.pixel_count());
  else
    evidence.flip = image::flip(evidence.a, evidence.b).map;
  return evidence;
}

}  // namespace skylapse::diff
