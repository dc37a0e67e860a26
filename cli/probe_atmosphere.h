#pragma once
// probe for the models that compute an atmosphere.
#include <optional>
#include <string>

#include "cli/console.h"
#include "cli/exit_code.h"

namespace skylapse::cli {

struct AtmosphereProbeArguments {
  std::string model;  // bruneton, single-scattering, reference
  std::string batch;
  std::string atmosphere;  // file; empty: the default air
  std::string level = "standard";
  std::string precision = "float";
  std::string backend = "auto";
  std::optional<long> samples;  // none: 100 000, or with a relative error at most 100 000 000
  std::optional<double> relative_error;
  long seed = 1;
};

bool is_atmosphere_model(const std::string& model);

ExitCode run_atmosphere_probe(const AtmosphereProbeArguments& arguments,
                              const ConsoleOptions& console);

}  // namespace skylapse::cli
