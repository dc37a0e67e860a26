#include "pipeline/ledger.h"

#include "pipeline/job_fixture.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

LedgerEntry write_file(const std::filesystem::path& folder, const std::string& name,
                       const std::string& text, const std::string& fingerprint) {
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  EXPECT_TRUE(output::write_file_atomically(folder / name, bytes).ok());
  return {name, fingerprint, sha256_hex(text), text.size(), {}, {}, {}};
}

TEST(Ledger, RemembersFinishedFilesAcrossProcesses) {
  const TemporaryFolder folder;
  {
    auto ledger = Ledger::open(folder.path(), "all");
    ASSERT_TRUE(ledger.ok());
    ASSERT_TRUE(ledger->record(write_file(folder.path(), "a.png", "pixels", "f1")).ok());
  }
  auto again = Ledger::open(folder.path(), "all");
  EXPECT_TRUE(again->finished("a.png", "f1").has_value());
  EXPECT_FALSE(again->finished("a.png", "f2").has_value()) << "another config's frame is stale";
}

TEST(Ledger, ADamagedFileIsNotFinished) {
  const TemporaryFolder folder;
  auto ledger = Ledger::open(folder.path(), "all");
  ASSERT_TRUE(ledger->record(write_file(folder.path(), "a.png", "pixels", "f1")).ok());
  std::ofstream(folder.path() / "a.png") << "pixelz";
  EXPECT_FALSE(ledger->finished("a.png", "f1").has_value());
  std::filesystem::remove(folder.path() / "a.png");
  EXPECT_FALSE(ledger->finished("a.png", "f1").has_value());
}

TEST(Ledger, ATornLineCostsOnlyItself) {
  const TemporaryFolder folder;
  {
    auto ledger = Ledger::open(folder.path(), "all");
    ASSERT_TRUE(ledger->record(write_file(folder.path(), "a.png", "pixels", "f1")).ok());
  }
  std::ofstream(folder.path() / ".skylapse/ledger.all.jsonl", std::ios::app)
      << "{\"path\":\"b.png\",\"finger";
  auto again = Ledger::open(folder.path(), "all");
  ASSERT_TRUE(again->record(write_file(folder.path(), "c.png", "more", "f3")).ok());
  auto third = Ledger::open(folder.path(), "all");
  EXPECT_TRUE(third->finished("a.png", "f1").has_value());
  EXPECT_TRUE(third->finished("c.png", "f3").has_value());
  EXPECT_FALSE(third->find("b.png", "").has_value());
}

TEST(Ledger, AnotherProcessesOldRecordDoesNotHideANewOne) {
  const TemporaryFolder folder;
  auto first = Ledger::open(folder.path(), "shard-1-of-2");
  ASSERT_TRUE(first->record(write_file(folder.path(), "a.png", "old", "f1")).ok());
  auto second = Ledger::open(folder.path(), "all");
  ASSERT_TRUE(second->record(write_file(folder.path(), "a.png", "new", "f2")).ok());
  auto again = Ledger::open(folder.path(), "all");
  EXPECT_TRUE(again->finished("a.png", "f2").has_value());
  EXPECT_FALSE(again->finished("a.png", "f1").has_value());
}

}  // namespace
