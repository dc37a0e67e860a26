#include "diff/pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/printable.h"
#include "diff/comparison_side.h"
#include "diff/file_names.h"

namespace skylapse::diff {
namespace {

Finding finding(const char* check, std::string message, Verdict severity = Verdict::different) {
  return {.severity = severity, .check = check, .message = std::move(message), .place = {}};
}

Result<ComparisonSide> side_of(const std::string& path, const std::vector<std::string>& ignore) {
  auto side = read_side(path);
  if (side && side->kind != ComparisonSide::Kind::file)
    std::erase_if(side->names, [&](const std::string& name) {
      return std::ranges::any_of(ignore, [&](const auto& glob) { return fits_glob(name, glob); });
    });
  return side;
}

void fill_b(const ComparisonSide& b, const std::string& name, FilePair& pair) {
  pair.b = b.path_of(name);
  if (const ManifestFile* told = b.told(name)) pair.manifest_entry_b = told->entry;
  pair.renderer_b = b.renderer_of(name);
}

void fill_a(const ComparisonSide& a, const std::string& name, FilePair& pair) {
  pair.a = a.path_of(name);
  if (const ManifestFile* told = a.told(name)) pair.manifest_entry_a = told->entry;
  pair.renderer_a = a.renderer_of(name);
}

/// Sequences as a manifest tells them, else as the names do. Pairs are in the order of their names,
/// or, of a manifest, of their frames.
void number_sequences(const ComparisonSide& side, const std::vector<std::string>& names,
                      std::vector<FilePair>& pairs) {
  std::map<std::string, std::vector<size_t>> told;
  std::vector<std::string> others;
  std::vector<size_t> other_numbers;
  for (size_t i = 0; i < names.size(); ++i) {
    if (const ManifestFile* file = side.told(names[i])) {
      told[file->sequence].push_back(i);
    } else {
      others.push_back(names[i]);
      other_numbers.push_back(i);
    }
  }
  int next = 0;
  const auto by_name = sequences_of(others);
  for (size_t i = 0; i < others.size(); ++i) {
    pairs[other_numbers[i]].sequence = by_name[i];
    next = std::max(next, by_name[i] + 1);
  }
  for (const auto& [key, members] : told) {
    if (members.size() < 2) continue;
    for (const size_t i : members) pairs[i].sequence = next;
    ++next;
  }
}

/// By name, but files of a manifest in the order of their frames: names need not tell it.
void put_in_order(const ComparisonSide& side, std::vector<std::string>& names) {
  std::ranges::sort(names, comes_before);
  std::map<std::string, std::vector<size_t>> told;
  for (size_t i = 0; i < names.size(); ++i)
    if (const ManifestFile* file = side.told(names[i])) told[file->sequence].push_back(i);
  for (const auto& [key, places] : told) {
    std::vector<std::string> members;
    for (const size_t place : places) members.push_back(names[place]);
    std::ranges::stable_sort(members, {}, [&](const auto& n) { return side.told(n)->frame; });
    for (size_t i = 0; i < places.size(); ++i) names[places[i]] = members[i];
  }
}

std::string parent_of(const std::string& name) {
  const size_t slash = name.rfind('/');
  return slash == name.npos ? std::string() : name.substr(0, slash);
}

/// Folders that hold images, at any depth; the uppermost is "".
std::set<std::string> folders_of(const std::vector<std::string>& names) {
  std::set<std::string> folders{""};
  for (const std::string& name : names)
    for (std::string folder = parent_of(name); folders.insert(folder).second;)
      folder = parent_of(folder);
  return folders;
}

/// The uppermost folder above `name` that A does not have; empty: it has them all.
std::string folder_only_in_b(const std::set<std::string>& folders_a, const std::string& name) {
  std::string found;
  for (std::string folder = parent_of(name); folders_a.count(folder) == 0;
       folder = parent_of(folder))
    found = folder;
  return found;
}

void report_extra(const std::vector<std::string>& names_a, const std::vector<std::string>& extra,
                  std::vector<Finding>& findings) {
  const auto folders_a = folders_of(names_a);
  std::map<std::string, size_t> whole_folders;
  for (const std::string& name : extra) {
    const std::string folder = folder_only_in_b(folders_a, name);
    if (folder.empty())
      findings.push_back(
          finding("sequence.extra", fmt::format("B has '{}', A has not", printable(name))));
    else
      ++whole_folders[folder];
  }
  for (const auto& [folder, count] : whole_folders)
    findings.push_back(
        finding("folder.extra",
                fmt::format("B has a folder '{}' with {} image{}, A has no such folder",
                            printable(folder), count, count == 1 ? "" : "s"),
                Verdict::warning));
}

/// Name in B of each name in A: the same, or, of manifests that have no name in common, that of the
/// same frame.
std::map<std::string, std::string> counterparts(const ComparisonSide& a, const ComparisonSide& b) {
  const std::set<std::string> in_b(b.names.begin(), b.names.end());
  std::map<std::string, std::string> partner;
  for (const std::string& name : a.names)
    if (in_b.count(name) > 0) partner[name] = name;
  if (!partner.empty() || a.kind != ComparisonSide::Kind::manifest) return partner;
  std::map<std::string, std::string> by_key;
  for (const std::string& name : b.names)
    if (const ManifestFile* told = b.told(name)) by_key[told->key] = name;
  for (const std::string& name : a.names)
    if (const ManifestFile* told = a.told(name))
      if (const auto found = by_key.find(told->key); found != by_key.end())
        partner[name] = found->second;
  return partner;
}

PairList pair_many(const ComparisonSide& a, const ComparisonSide& b) {
  PairList list;
  for (const ComparisonSide* side : {&a, &b})
    list.findings.insert(list.findings.end(), side->findings.begin(), side->findings.end());
  const auto partner = counterparts(a, b);
  std::set<std::string> taken;
  std::vector<std::string> paired;
  for (const std::string& name : a.names) {
    const auto found = partner.find(name);
    if (found == partner.end()) {
      list.findings.push_back(
          finding("sequence.missing", fmt::format("A has '{}', B has not", printable(name))));
    } else {
      paired.push_back(name);
      taken.insert(found->second);
    }
  }
  put_in_order(a, paired);
  for (const std::string& name : paired) {
    FilePair pair;
    pair.name = name;
    fill_a(a, name, pair);
    fill_b(b, partner.at(name), pair);
    list.pairs.push_back(std::move(pair));
  }
  number_sequences(a, paired, list.pairs);
  std::vector<std::string> extra;
  for (const std::string& name : b.names)
    if (taken.count(name) == 0) extra.push_back(name);
  report_extra(a.names, extra, list.findings);
  return list;
}

Error no_images(const std::string& path) {
  return {.code = ErrorCode::missing_input,
          .message = fmt::format("there is no image in '{}'", printable(path)),
          .hint = "images are known by their extension; hidden and ignored files do not count"};
}

std::string_view words_for(ComparisonSide::Kind kind) {
  switch (kind) {
    case ComparisonSide::Kind::file:
      return "an image";
    case ComparisonSide::Kind::folder:
      return "a folder";
    case ComparisonSide::Kind::manifest:
      return "a manifest";
  }
  return {};
}

}  // namespace

Result<PairList> pair_files(const std::string& a, const std::string& b,
                            const std::vector<std::string>& ignore) {
  const auto side_a = side_of(a, ignore);
  if (!side_a) return side_a.error();
  const auto side_b = side_of(b, ignore);
  if (!side_b) return side_b.error();
  if (side_a->kind != side_b->kind)
    return Error{
        .code = ErrorCode::invalid_input,
        .message = fmt::format("'{}' is {} and '{}' is {}", printable(a), words_for(side_a->kind),
                               printable(b), words_for(side_b->kind)),
        .hint = "compare two images, two folders or two manifests"};
  if (side_a->names.empty()) return no_images(a);
  if (side_a->kind != ComparisonSide::Kind::file) return pair_many(*side_a, *side_b);
  PairList list;
  FilePair pair;
  pair.name = side_a->names.front();
  fill_a(*side_a, side_a->names.front(), pair);
  fill_b(*side_b, side_b->names.front(), pair);
  list.pairs.push_back(std::move(pair));
  return list;
}

Result<PairList> list_files(const std::string& path, const std::vector<std::string>& ignore) {
  auto side = side_of(path, ignore);
  if (!side) return side.error();
  if (side->names.empty()) return no_images(path);
  PairList list{.pairs = {}, .findings = side->findings};
  put_in_order(*side, side->names);
  for (const std::string& name : side->names) {
    FilePair pair;
    pair.name = name;
    fill_b(*side, name, pair);
    list.pairs.push_back(std::move(pair));
  }
  number_sequences(*side, side->names, list.pairs);
  return list;
}

}  // namespace skylapse::diff
