#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "config/build_job.h"

namespace skylapse::config {
namespace {

Site build_site(const Section& section, size_t index, const ReadContext& context) {
  Site site;
  site.name = section.get<std::string>("name").value_or(fmt::format("site{}", index + 1));
  site.position = {section.get<double>("latitude").value_or(0) * rad,
                   section.get<double>("longitude").value_or(0) * rad,
                   section.get<double>("height").value_or(0) * metre};
  if (const auto zone = section.get<std::string>("zone"))
    site.zone = Spanned<std::string>{*zone, context.sources.span(section.place_of("zone"))};
  site.span = context.sources.span(section.place);
  if (section.has("name") && !names_a_file(site.name))
    context.errors.add(
        section.place_of("name"),
        fmt::format("{} = {} holds no letter or digit", section.path_of("name"), site.name),
        "names become part of file names");
  return site;
}

}  // namespace

std::shared_ptr<const Section> only_section(const Section& parent, std::string_view key) {
  const auto sections = parent.sections(key);
  return sections.empty() ? nullptr : sections.front();
}

bool names_a_file(std::string_view name) {
  return std::any_of(name.begin(), name.end(), [](unsigned char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c >= 0x80;
  });
}

std::vector<Site> build_sites(const Section& root, const ReadContext& context) {
  std::vector<std::shared_ptr<const Section>> sections = root.sections("location");
  if (sections.empty()) sections = root.sections("locations");
  std::vector<Site> sites;
  std::map<std::string, int> lines;
  for (size_t i = 0; i < sections.size(); ++i) {
    sites.push_back(build_site(*sections[i], i, context));
    const auto [first, is_new] = lines.emplace(sites.back().name, sites.back().span.line);
    if (!is_new)
      context.errors.add(
          sections[i]->has("name") ? sections[i]->place_of("name") : sections[i]->place,
          fmt::format("two locations are named {}", first->first),
          fmt::format("the first is on line {}; names must differ", first->second));
  }
  return sites;
}

}  // namespace skylapse::config
