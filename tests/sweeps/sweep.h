#pragma once
// Sweeps: a public function evaluated over its whole domain, the ends included, many times over.
// What is counted is the same in the short run (a test) and in the long one (the command sweep).
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace skylapse::sweeps {

/// What a sweep found.
struct Finding {
  long evaluations = 0;
  long non_finite = 0;  // values that are no number where the function promises one
  long broken = 0;      // broken laws: out of range, not monotone, a failure where there is none
  double worst = 0;     // greatest error, in the sweep's own measure
  std::string where;    // its arguments
  std::string first_broken;  // arguments of the first non-finite value or broken law

  void add(const Finding& other);
};

/// Numbers for one evaluation: the same for the same sweep and index, whatever the threads.
class Draw {
 public:
  Draw(uint64_t sweep, uint64_t index) : state_(sweep * 0x9E3779B97F4A7C15u + index) { bits(); }
  uint64_t bits();
  /// Even in [0, 1).
  double unit() { return double(bits() >> 11) * 0x1p-53; }
  int below(int n) { return int(bits() % uint64_t(n)); }
  /// In [low, high]: half even; the rest the ends themselves, their neighbours, places at any
  /// distance from them by magnitude, zero and denormals where they lie inside.
  double in(double low, double high);
  /// The same, a float.
  float float_in(float low, float high);
  /// From `low` to `high` (both above 0) by magnitude, ends included.
  double magnitude(double low, double high);

 private:
  uint64_t state_;
};

/// Collects one piece of a sweep.
class Tally {
 public:
  explicit Tally(Finding& finding) : finding_(finding) {}
  /// Counts an evaluation; false if the value is not finite. `where` makes the arguments' text.
  template <class Where>
  bool finite(double value, const Where& where) {
    ++finding_.evaluations;
    if (std::isfinite(value)) return true;
    if (finding_.non_finite++ == 0 && finding_.first_broken.empty())
      finding_.first_broken = where();
    return false;
  }
  template <class Where>
  void law(bool holds, const Where& where) {
    if (holds) return;
    if (finding_.broken++ == 0 && finding_.first_broken.empty()) finding_.first_broken = where();
  }
  template <class Where>
  void error(double size, const Where& where) {
    if (!(size > finding_.worst)) return;
    finding_.worst = size;
    finding_.where = where();
  }

 private:
  Finding& finding_;
};

struct Sweep {
  std::string name;
  std::string measure;  // of the error
  double bound;         // of it
  std::string reason;   // for the bound
  double share = 1;     // of the evaluations asked for: costly functions take fewer
  std::function<void(Draw& draw, Tally& tally)> once;
};

/// `count * share` draws on all cores.
Finding run(const Sweep& sweep, long count, uint64_t seed);

/// Every sweep, by subject.
std::vector<Sweep> all_sweeps();
void add_text_sweeps(std::vector<Sweep>& sweeps);   // the shaders' physics, float against double
void add_air_sweeps(std::vector<Sweep>& sweeps);    // profiles, phase functions, sky models
void add_sun_sweeps(std::vector<Sweep>& sweeps);    // ephemerides, geodesy, refraction
void add_image_sweeps(std::vector<Sweep>& sweeps);  // cameras, coverage
void add_value_sweeps(std::vector<Sweep>& sweeps);  // colour, exposure, quantities as text

}  // namespace skylapse::sweeps
