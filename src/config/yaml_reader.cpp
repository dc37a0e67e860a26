#include "config/yaml_reader.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "config/yaml_text.h"

namespace skylapse::config {
namespace {

/// Leaves the parser once an error makes the rest of the text meaningless or too large.
struct Abandoned {};

/// Builds our tree from parser events. The stack is ours, so nesting is bounded here.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const SourceSet& sources, int source, ErrorList& errors, const YamlLimits& limits)
      : sources_(sources), source_(source), errors_(errors), limits_(limits) {}

  Node take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Node node;
    node.place = place_at(mark);
    const std::string_view written = rest_of_line(node.place);
    const bool has_text = written.starts_with("~") || written.starts_with("null") ||
                          written.starts_with("Null") || written.starts_with("NULL");
    if (expects_key()) {
      add_key(has_text ? "null" : "", node.place);
      return;
    }
    // The place of an absent value is that of its key, where the reader has to write it.
    if (!has_text && !open_.empty() && open_.back().key) node.place = open_.back().key_place;
    add_value(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const Place place = place_at(mark);
    if (expects_key()) abandon(place, "an alias cannot be a key");
    const auto known = anchors_.find(anchor);
    if (known == anchors_.end())
      abandon(place, "this alias stands inside the value that it names",
              "an alias can only repeat a value that is complete");
    nodes_ += known->second.nodes;
    text_bytes_ += known->second.text_bytes;
    check_size(place);
    if (open_.size() + size_t(known->second.depth) > size_t(limits_.depth)) too_deep(place);
    if (!open_.empty())
      open_.back().depth_below = std::max(open_.back().depth_below, known->second.depth);
    Node copy = known->second.node;
    put(std::move(copy));
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    const Place start = place_at(mark);
    const ScalarExtent extent = scalar_extent(rest_of_line(start), value);
    Place place = start;
    place.column += int(extent.begin);
    place.length = int(std::max<size_t>(extent.length, 1));
    if (value.size() > limits_.scalar_bytes)
      abandon(place, fmt::format("this text is {} characters long", value.size()),
              fmt::format("allowed: at most {}", limits_.scalar_bytes));
    // yaml-cpp accepts some quotes that never close, and values here are one line anyway.
    if (!extent.closed)
      abandon(place, "the quote is not closed on its line", "text in quotes is one line");
    refuse_tag(tag, start);
    if (expects_key()) {
      add_key(value, place);
      return;
    }
    Node node;
    node.kind = Node::Kind::scalar;
    node.text = value;
    node.quoted = tag == "!";
    node.verbatim = extent.verbatim;
    node.place = place;
    if (extent.verbatim && extent.quotes)
      ++node.place.column, node.place.length = std::max(1, node.place.length - 2);
    text_bytes_ += value.size();
    add_value(std::move(node), anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(Node::Kind::sequence, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(Node::Kind::map, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    Node node;
    YAML::anchor_t anchor = 0;
    size_t nodes_before = 0, text_before = 0;
    int depth_below = 0;
    std::optional<std::string> key;  // waiting for its value
    Place key_place;
    bool duplicate = false;
    std::map<std::string, Place, std::less<>> keys;
  };
  struct Anchored {
    Node node;
    size_t nodes, text_bytes;
    int depth;
  };

  [[nodiscard]] Place place_at(const YAML::Mark& mark) const {
    return {source_, mark.line + 1, mark.column + 1, 1};
  }
  [[nodiscard]] std::string_view rest_of_line(const Place& place) const {
    const std::string_view line = sources_.line(source_, place.line);
    return line.substr(std::min(line.size(), size_t(place.column - 1)));
  }
  [[noreturn]] void abandon(const Place& place, std::string message, std::string hint = {}) {
    errors_.add(place, std::move(message), std::move(hint));
    throw Abandoned{};
  }
  [[noreturn]] void too_deep(const Place& place) {
    abandon(place, "this is nested too deeply",
            fmt::format("allowed: at most {} levels", limits_.depth));
  }
  void check_size(const Place& place) {
    if (nodes_ > limits_.nodes)
      abandon(place, "the file holds too many values, aliases counted as often as they are used",
              fmt::format("allowed: at most {}", limits_.nodes));
    if (text_bytes_ > limits_.text_bytes)
      abandon(place, "the file holds too much text, aliases counted as often as they are used",
              fmt::format("allowed: at most {} bytes", limits_.text_bytes));
  }
  void refuse_tag(const std::string& tag, const Place& place) {
    if (!tag.empty() && tag != "?" && tag != "!")
      errors_.add(place, fmt::format("the YAML tag {} has no meaning here", tag.substr(0, 80)),
                  "remove the tag; types follow from the keys");
  }

  [[nodiscard]] bool expects_key() const {
    return !open_.empty() && open_.back().node.kind == Node::Kind::map && !open_.back().key;
  }
  void add_key(const std::string& key, const Place& place) {
    if (key.size() > 200) abandon(place, "this key is too long", "allowed: at most 200 characters");
    Open& map = open_.back();
    map.key = key;
    map.key_place = place;
    const auto [first, is_new] = map.keys.emplace(key, place);
    map.duplicate = !is_new;
    if (!is_new)
      errors_.add(place, fmt::format("the key \"{}\" is given twice", key),
                  fmt::format("first on line {}", first->second.line));
  }
  void add_value(Node node, YAML::anchor_t anchor) {
    ++nodes_;
    check_size(node.place);
    if (anchor != 0) anchors_[anchor] = {node, 1, node.text.size(), 0};
    put(std::move(node));
  }
  void put(Node node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == Node::Kind::sequence) {
      parent.node.items.push_back(std::move(node));
    } else {
      if (!parent.duplicate)
        parent.node.entries.push_back({*parent.key, parent.key_place, std::move(node)});
      parent.key.reset();
    }
  }
  void open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor) {
    const Place place = place_at(mark);
    refuse_tag(tag, place);
    if (expects_key())
      abandon(place, "a list or section stands where a key belongs",
              "close every [ and {, and put text that holds them in quotes");
    if (open_.size() >= size_t(limits_.depth)) too_deep(place);
    Open opened;
    opened.node.kind = kind;
    opened.node.place = place;
    opened.anchor = anchor;
    opened.nodes_before = nodes_;
    opened.text_before = text_bytes_;
    ++nodes_;
    check_size(place);
    open_.push_back(std::move(opened));
  }
  void close() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    const int depth = closed.depth_below + 1;
    if (!open_.empty()) open_.back().depth_below = std::max(open_.back().depth_below, depth);
    if (closed.anchor != 0)
      anchors_[closed.anchor] = {closed.node, nodes_ - closed.nodes_before,
                                 text_bytes_ - closed.text_before, depth};
    put(std::move(closed.node));
  }

  const SourceSet& sources_;
  int source_;
  ErrorList& errors_;
  const YamlLimits& limits_;
  Node root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchored> anchors_;
  size_t nodes_ = 0, text_bytes_ = 0;
};

std::string syntax_hint(const SourceSet& sources, const Place& place, const std::string& message) {
  if (message.find("flow not found") != std::string::npos)
    return "a [ or { before this is not closed, or a value holds one: put such text in quotes";
  const std::string_view line = sources.line(place.source, place.line);
  const size_t first = line.find_first_not_of(" \t");
  if (line.substr(0, first == std::string_view::npos ? line.size() : first).find('\t') !=
      std::string_view::npos)
    return "YAML does not allow tabs for indentation: use spaces";
  if (line.find_first_of("{}[]#&*!%@`'\"") != std::string_view::npos ||
      std::count(line.begin(), line.end(), ':') > 1)
    return "put text that holds any of { } [ ] # & * ! % @ or a colon and a space in quotes";
  return "sections are indented by spaces, each key as \"key: value\"";
}

}  // namespace

const Node* find_key(const Node& node, std::string_view key) {
  if (node.kind != Node::Kind::map) return nullptr;
  for (const MapEntry& entry : node.entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

Node* find_key(Node& node, std::string_view key) {
  return const_cast<Node*>(find_key(std::as_const(node), key));
}

std::optional<Node> read_yaml(const SourceSet& sources, int source, ErrorList& errors,
                              const YamlLimits& limits) {
  const std::string& text = sources.text(source);
  if (text.size() > limits.bytes) {
    errors.add({source, 0, 0, 1}, fmt::format("the file has {} bytes", text.size()),
               fmt::format("allowed: at most {}", limits.bytes));
    return std::nullopt;
  }
  if (const auto bad = first_bad_byte(text)) {
    errors.add(place_of_byte(sources, source, bad->offset), bad->what,
               "a config is plain text in UTF-8");
    return std::nullopt;
  }
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    TreeBuilder builder(sources, source, errors, limits);
    if (!parser.HandleNextDocument(builder)) return Node{};
    Node root = builder.take();
    TreeBuilder second(sources, source, errors, limits);
    if (parser.HandleNextDocument(second)) {
      errors.add({source, 0, 0, 1}, "the file holds more than one YAML document",
                 "one job is one document: remove the line \"---\" and what follows it");
      return std::nullopt;
    }
    return root;
  } catch (const Abandoned&) {
    return std::nullopt;
  } catch (const YAML::Exception& e) {
    Place place{source, std::max(e.mark.line, 0) + 1, std::max(e.mark.column, 0) + 1, 1};
    errors.add(place, "this is not valid YAML: " + e.msg, syntax_hint(sources, place, e.msg));
    return std::nullopt;
  }
}

}  // namespace skylapse::config
