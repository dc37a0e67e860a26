#include "config/yaml_reader.h"

#include <gtest/gtest.h>

namespace skylapse::config {
namespace {

struct Reading {
  SourceSet sources;
  ErrorList errors;
  std::optional<Node> root;
  Diagnostics found;
};

Reading read(const std::string& text, const YamlLimits& limits = {}) {
  Reading r;
  r.sources.add("job.yaml", normalised_text(text));
  r.root = read_yaml(r.sources, 0, r.errors, limits);
  r.found = r.errors.diagnostics(r.sources);
  return r;
}

const Node& at(const Node& node, const std::string& key) {
  static const Node none;
  const Node* found = find_key(node, key);
  EXPECT_NE(found, nullptr) << key;
  return found == nullptr ? none : *found;
}

TEST(YamlReader, EveryValueKnowsItsLineAndColumnFromOne) {
  const Reading r = read("location:\n  name: Prague   # comment\n  list: [a, 'b c', \"d\"]\n");
  ASSERT_TRUE(r.root.has_value() && r.found.empty());
  const Node& location = at(*r.root, "location");
  const Node& name = at(location, "name");
  EXPECT_EQ(name.text, "Prague");
  EXPECT_EQ(name.place.line, 2);
  EXPECT_EQ(name.place.column, 9);
  EXPECT_EQ(name.place.length, 6);
  EXPECT_EQ(location.entries[0].key_place.column, 3);
  const Node& list = at(location, "list");
  ASSERT_EQ(list.items.size(), 3u);
  EXPECT_EQ(list.items[0].place.column, 10);
  EXPECT_EQ(list.items[1].place.column, 14);  // inside the quotes
  EXPECT_EQ(list.items[1].place.length, 3);
  EXPECT_TRUE(list.items[1].quoted);
}

TEST(YamlReader, AnAbsentValueHasThePlaceOfItsKey) {
  const Reading r = read("a: 1\nsection:\n  key:\n  other: ~\n");
  ASSERT_TRUE(r.root.has_value());
  const Node& key = at(at(*r.root, "section"), "key");
  EXPECT_EQ(key.kind, Node::Kind::null);
  EXPECT_EQ(key.place.line, 3);
  EXPECT_EQ(key.place.column, 3);
  const Node& other = at(at(*r.root, "section"), "other");
  EXPECT_EQ(other.place.line, 4);
  EXPECT_EQ(other.place.column, 10);
}

TEST(YamlReader, ColumnsCountCharactersNotBytes) {
  SourceSet sources;
  sources.add("x", "latitude: 50°04'32\"N x");
  const SourceSpan span = sources.span({0, 1, 23, 1});
  EXPECT_EQ(span.column, 22);
  EXPECT_EQ(span.source_line, "latitude: 50°04'32\"N x");
}

TEST(YamlReader, LineEndsAndByteOrderMarksOfAnySystemReadTheSame) {
  for (const char* text : {"a: 1\nb: 2\n", "a: 1\r\nb: 2\r\n", "a: 1\rb: 2\r",
                           "\xEF\xBB\xBF"
                           "a: 1\nb: 2"}) {
    const Reading r = read(text);
    ASSERT_TRUE(r.root.has_value());
    EXPECT_EQ(at(*r.root, "b").text, "2");
    EXPECT_EQ(at(*r.root, "b").place.line, 2);
    EXPECT_EQ(at(*r.root, "a").place.column, 4);
  }
}

TEST(YamlReader, ADuplicateKeyIsReportedWithTheLineOfTheFirst) {
  const Reading r = read("a: 1\nb: 2\na: 3\n");
  ASSERT_EQ(r.found.size(), 1u);
  EXPECT_EQ(r.found[0].message, "the key \"a\" is given twice");
  EXPECT_EQ(r.found[0].hint, "first on line 1");
  EXPECT_EQ(r.found[0].span.line, 3);
  EXPECT_EQ(at(*r.root, "a").text, "1");
}

TEST(YamlReader, BrokenSyntaxIsOneErrorWithItsPlace) {
  struct Row {
    const char* text;
    int line, column;
  };
  for (const Row& row :
       {Row{"a: [1, 2\nb: 3\n", 2, 2}, Row{"a:\n\tb: 1\n", 2, 3}, Row{"a: b: c\n", 1, 5},
        Row{"a: 'open\nb: 1\n", 1, 4}, Row{"a: *nobody\n", 1, 4}, Row{"a: 1\n b: 2\n", 2, 3},
        Row{"a: {b}.png\n", 1, 7}, Row{"a: !!int 3\n", 1, 4}, Row{"? [a]\n: b\n", 1, 3},
        Row{"a: @b\n", 1, 4}}) {
    const Reading r = read(row.text);
    ASSERT_EQ(r.found.size(), 1u) << row.text;
    EXPECT_EQ(r.found[0].span.line, row.line) << row.text << r.found[0].message;
    EXPECT_EQ(r.found[0].span.column, row.column) << row.text << r.found[0].message;
  }
}

TEST(YamlReader, TabsInTheIndentationAreNamedAsTheCause) {
  const Reading r = read("a:\n\tb: 1\n");
  ASSERT_EQ(r.found.size(), 1u);
  EXPECT_EQ(r.found[0].hint, "YAML does not allow tabs for indentation: use spaces");
}

TEST(YamlReader, FilesThatAreNoTextAreRefusedAtTheFirstBadByte) {
  const Reading binary = read(std::string("a: 1\nb: \0\1", 10));
  ASSERT_EQ(binary.found.size(), 1u);
  EXPECT_EQ(binary.found[0].span.line, 2);
  EXPECT_EQ(binary.found[0].span.column, 4);
  EXPECT_TRUE(binary.found[0].span.source_line.empty());  // it could steer the terminal
  for (const char* text : {"a: \xFF\n", "a: \xC0\xAF\n", "a: \xED\xA0\x80\n",
                           "a: \xF5\x80\x80\x80\n", "a: \xC3", "\xFE\xFF", "a: \x1B[31m\n"}) {
    EXPECT_EQ(read(text).found.size(), 1u);
    EXPECT_FALSE(read(text).root.has_value());
  }
}

TEST(YamlReader, ASecondDocumentIsRefused) {
  EXPECT_EQ(read("a: 1\n---\nb: 2\n").found.size(), 1u);
  EXPECT_TRUE(read("---\na: 1\n...\n").found.empty());
}

TEST(YamlReader, AnEmptyTextIsNoValueAndNoError) {
  for (const char* text : {"", "\n\n", "# only a comment\n", "---\n", "   "}) {
    const Reading r = read(text);
    ASSERT_TRUE(r.root.has_value());
    EXPECT_EQ(r.root->kind, Node::Kind::null);
    EXPECT_TRUE(r.found.empty());
  }
}

TEST(YamlReader, AliasesRepeatTheirValue) {
  const Reading r = read("a: &x {k: 1}\nb: *x\n");
  ASSERT_TRUE(r.root.has_value());
  EXPECT_EQ(at(at(*r.root, "b"), "k").text, "1");
}

}  // namespace
}  // namespace skylapse::config
