#pragma once
// Figures and the page that explains a study.
#include <string>
#include <vector>

#include "study/study_result.h"

namespace skylapse::study {

/// A figure as an SVG document of its own.
struct Figure {
  std::string name;   // "pareto_noon"
  std::string title;  // of the figure, in words
  std::string svg;
};

/// Error against time of each scene, with its front; then the groups of rungs as small multiples.
std::vector<Figure> figures_of(const StudyResult& study);

/// One page with everything in it: nothing is loaded from elsewhere. Errors: the image module.
Result<std::string> report_html(const StudyResult& study);

}  // namespace skylapse::study
