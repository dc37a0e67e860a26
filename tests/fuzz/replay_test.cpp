// The corpus of the fuzzers under the product's own compiler: seeds, hostile texts made by hand and
// every input that once broke a law. Each file goes to its target; truncations go too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "config/key_spec.h"
#include "fuzz/targets.h"

namespace skylapse::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kCorpus = fs::path(SKYLAPSE_SOURCE_DIR) / "tests/fuzz/corpus";

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A target's seeds: its own folder, and for whole files the examples that users are given.
std::vector<fs::path> seeds_of(std::string_view target) {
  std::vector<fs::path> folders{kCorpus / target};
  const fs::path configs = fs::path(SKYLAPSE_SOURCE_DIR) / "configs";
  if (target == "job" || target == "yaml") folders.push_back(configs);
  if (target == "atmosphere") folders.push_back(configs / "atmospheres");
  std::vector<fs::path> files;
  for (const fs::path& folder : folders)
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class FuzzCorpus : public testing::TestWithParam<Target> {};

TEST_P(FuzzCorpus, KeepsTheLawsOfItsReader) {
  const auto files = seeds_of(GetParam().name);
  ASSERT_GE(files.size(), 5u) << GetParam().name;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    GetParam().run(read(file));
  }
}

TEST_P(FuzzCorpus, KeepsThemWhenFilesAreCutAnywhere) {
  for (const fs::path& file : seeds_of(GetParam().name)) {
    SCOPED_TRACE(file);
    const std::string text = read(file);
    const size_t step = std::max<size_t>(1, text.size() / 16);
    for (size_t end = 0; end < text.size(); end += step)
      GetParam().run(std::string_view(text).substr(0, end));
  }
}

/// A few changes at random places: bytes flipped, removed, doubled, or taken from another seed.
std::string mutated(std::string text, const std::string& other, std::mt19937& random) {
  const auto at = [&](const std::string& s) { return s.empty() ? 0 : random() % (s.size() + 1); };
  for (unsigned change = 0; change <= random() % 4; ++change) {
    const size_t place = at(text);
    const size_t length = std::min<size_t>(1 + random() % 12, text.size() - place);
    switch (random() % 4) {
      case 0:
        if (length > 0) text[place] = char(random());
        break;
      case 1:
        text.erase(place, length);
        break;
      case 2:
        text.insert(place, std::string(text, place, length));
        break;
      default:
        text.insert(place, other.substr(at(other), 1 + random() % 30));
    }
  }
  return text;
}

/// 2000, or what the environment asks for: nightly runs have more patience.
int mutations() {
  const char* asked = std::getenv("SKYLAPSE_MUTATIONS");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : 2000;
}

/// What libFuzzer does with more patience, so that every run of the tests tries some new inputs'
/// worth of hostility; the same ones each time.
TEST_P(FuzzCorpus, KeepsThemUnderMutations) {
  std::vector<std::string> seeds;
  for (const fs::path& file : seeds_of(GetParam().name)) seeds.push_back(read(file));
  std::mt19937 random(20260621);
  for (int i = 0; i < mutations(); ++i) {
    const std::string& seed = seeds[random() % seeds.size()];
    GetParam().run(mutated(seed, seeds[random() % seeds.size()], random));
  }
}

INSTANTIATE_TEST_SUITE_P(Target, FuzzCorpus, testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& info) { return std::string(info.param.name); });

void collect_keys(const config::SectionSpec& section, std::vector<std::string>& keys, int depth) {
  for (const config::KeySpec& key : section.keys) {
    keys.emplace_back(key.name);
    for (const config::SectionSpec* below : key.sections)
      if (depth < 6) collect_keys(*below, keys, depth + 1);
  }
}

TEST(FuzzDictionary, KnowsEveryKeyOfAJob) {
  const std::string dictionary = read(fs::path(SKYLAPSE_SOURCE_DIR) / "tests/fuzz/config.dict");
  std::vector<std::string> keys;
  collect_keys(config::job_spec(), keys, 0);
  ASSERT_GT(keys.size(), 50u);
  for (const std::string& key : keys)
    EXPECT_NE(dictionary.find("\"" + key + ": \""), std::string::npos)
        << "tests/fuzz/config.dict lacks \"" << key << ": \"";
}

}  // namespace
}  // namespace skylapse::fuzz
