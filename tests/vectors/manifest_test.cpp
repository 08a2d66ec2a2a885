// The manifest as text and back, sums of files, rules of recipes, conformance levels of streams.
#include "vectors/manifest.hpp"

#include <gtest/gtest.h>

#include <hmlfc/stream_info.hpp>

#include "io/files.hpp"
#include "io/temp_folder.hpp"
#include "vectors/digest.hpp"
#include "vectors/field_rules.hpp"
#include "vectors/generate.hpp"

namespace hmlfc::vectors {
namespace {

std::vector<uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

Manifest sample_manifest() {
  Manifest manifest{"1.2.3", 1, "hmlfc vectors generate", 7, {}, "1.0.1", {}};
  Vector ok;
  ok.id = VectorId("syntax/one");
  ok.group = "syntax";
  ok.level = 2;
  ok.clauses = {"BISE-3"};
  ok.flags = {"depth8"};
  ok.comment = "hunts";
  ok.milestone = "motion";
  ok.input = {FileName("syntax/one.hmlfc"), 99, std::string(64, 'a')};
  ok.output = ViewSum{std::string(64, 'b'), 1, 2, 3, 4, 12, ChromaFormat::k444};
  ok.blocks = SuiteFile{FileName("syntax/one.blocks"), 0, std::string(64, 'c')};
  ok.trace = TraceFiles{{FileName("syntax/one.trace.jsonl"), 0, std::string(64, 'd')},
                        {FileName("syntax/one.trace.hex"), 0, std::string(64, 'e')}};
  Vector bad = ok;
  bad.id = VectorId("error/two");
  bad.profile = Profile::kExtended;
  bad.expect = {Outcome::kReject,  ErrorCode::kBadLevels,        1234,
                Operation::kBlock, {{{1, 2}, Plane::kCg, 3, 4}}, {}};
  bad.base = ok.id;
  bad.output.reset();
  bad.trace.reset();
  manifest.vectors = {bad, ok};
  Vector frame = ok;
  frame.id = VectorId("frames/three");
  frame.milestone = "plane";
  frame.output.reset();
  frame.frame.emplace().camera = camera_from_words("focal=20.5,pu=1,pv=0.1,pz=-2");
  frame.frame->record.emplace(HMLFC_DUT_RECORD_NUMBERS, -3);
  frame.frame->frame = FrameSum{5, 6, 12, std::string(64, 'f'), 1, 2, 3};
  Vector refused = frame;
  refused.id = VectorId("frames/four");
  refused.expect.outcome = Outcome::kReject;
  refused.expect.input = "focal";
  refused.base = frame.id;
  refused.frame->record.reset();
  refused.frame->frame.reset();
  manifest.frames = {refused, frame};
  return manifest;
}

TEST(Manifest, ReadsWhatItWrites) {
  const test::TempFolder folder;
  const std::string text = manifest_text(sample_manifest());
  ASSERT_TRUE(io::write_file(folder.path() / "manifest.json", bytes_of(text)));
  const auto read = read_manifest(folder.path());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(manifest_text(*read), text);
  const Vector& bad = read->vectors[0];
  EXPECT_EQ(bad.expect.error, ErrorCode::kBadLevels);
  EXPECT_EQ(bad.expect.offset, 1234u);
  EXPECT_EQ(bad.expect.blocks.at(0).plane, Plane::kCg);
  EXPECT_EQ(bad.expect.blocks.at(0).by, 4u);
  EXPECT_EQ(read->vectors[1].output->chroma, ChromaFormat::k444);
}

TEST(Manifest, SaysWhatIsWrong) {
  const test::TempFolder folder;
  const std::string good = manifest_text(sample_manifest());
  const auto message = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    EXPECT_TRUE(io::write_file(folder.path() / "manifest.json", bytes_of(text)));
    const auto read = read_manifest(folder.path());
    return read ? std::string() : read.error().message;
  };
  EXPECT_NE(read_manifest(folder.path() / "none").error().message.find("none"), std::string::npos);
  EXPECT_NE(message("bad_levels", "bad_thing").find("error/two"), std::string::npos);
  EXPECT_NE(message("\"count\": 2", "\"count\": 3").find("count"), std::string::npos);
  EXPECT_NE(message("\"outcome\": \"ok\"", "\"outcome\": \"fine\"").find("outcome"),
            std::string::npos);
  EXPECT_NE(message("\"base\": \"syntax/one\"", "\"base\": \"error/two\"").find("its base"),
            std::string::npos);
  EXPECT_NE(message("\"base\"", "\"basis\"").find("its base do not fit"), std::string::npos);
  EXPECT_NE(message("\"milestone\": \"motion\"", "\"milestone\": \"emotion\"").find("emotion"),
            std::string::npos);
  EXPECT_NE(message("{", "").find("manifest.json"), std::string::npos);
}

TEST(Manifest, NamesAreNoPaths) {
  for (const char* text : {"", "a", "/a", "a/", "/a/b", "a/b/c", "a/..", "../a", "a/.", "A/b",
                           "a/b c", "a//b", "a/b\\c", "a/b\n"}) {
    EXPECT_THROW(VectorId{text}, TextError) << text;
    EXPECT_THROW(FileName{text}, TextError) << text;
  }
  for (const char* text : {"a/b.", "a/.b", "a/b..c", "a.b/c", "a/b.c/../d"}) {
    EXPECT_THROW(FileName{text}, TextError) << text;
  }
  EXPECT_THROW(VectorId{"syntax/one.hmlfc"}, TextError);
  const std::filesystem::path suite = "suite";
  EXPECT_EQ(suite / FileName("syntax/one-2.trace.hex"), "suite/syntax/one-2.trace.hex");
  EXPECT_EQ(suite / VectorId("syntax/one-2"), "suite/syntax/one-2");
}

TEST(Suite, RemovesOnlyWhatItHasMade) {
  const test::TempFolder folder;
  const std::vector<uint8_t> bytes = bytes_of("x");
  Manifest manifest = sample_manifest();
  SuiteFiles files{{"manifest.json", bytes_of(manifest_text(manifest))},
                   {"syntax/one.hmlfc", bytes},
                   {"syntax/one.blocks", bytes},
                   {"syntax/one.trace.hex", bytes},
                   {"syntax/one.trace.jsonl", bytes}};
  ASSERT_TRUE(write_suite(files, folder.path()));
  ASSERT_TRUE(io::write_file(folder.path() / "syntax/mine.txt", bytes));
  files.erase("syntax/one.blocks");
  files["manifest.json"] = bytes;
  ASSERT_TRUE(write_suite(files, folder.path()));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "syntax/one.blocks"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "syntax/one.trace.hex"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "syntax/mine.txt"));
}

TEST(Suite, IsNotWrittenThroughLinks) {
  const test::TempFolder folder;
  const test::TempFolder other;
  const std::vector<uint8_t> bytes = bytes_of("x");
  const SuiteFiles none{{"manifest.json", bytes}};
  SuiteFiles files{{"manifest.json", bytes_of(manifest_text(sample_manifest()))}};
  ASSERT_TRUE(write_suite(files, folder.path()));
  ASSERT_TRUE(io::write_file(other / "one.blocks", bytes));
  std::filesystem::create_directory_symlink(other.path(), folder / "syntax");
  EXPECT_FALSE(write_suite(none, folder.path()));
  files["syntax/two.hmlfc"] = bytes;
  EXPECT_FALSE(write_suite(files, folder.path()));
  EXPECT_EQ(other.names(), std::set<std::string>{"one.blocks"});

  std::filesystem::remove(folder / "syntax");
  std::filesystem::create_directory(folder / "syntax");
  std::filesystem::create_symlink(other / "one.blocks", folder / "syntax/two.hmlfc");
  EXPECT_FALSE(write_suite(files, folder.path()));
  EXPECT_EQ(std::filesystem::file_size(other / "one.blocks"), 1u);
}

// FIPS 180-4, examples of SHA-256: one block and no message.
TEST(Sha256, PublishedValues) {
  EXPECT_EQ(sha256(bytes_of("abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256({}), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(FieldRule, TakesItsTermsInTurn) {
  Random random(1);
  FieldRule rule = FieldRule::from(Json::parse(R"({"of": ["min", 3, "max", "ramp"]})"));
  std::vector<int64_t> picked;
  for (int i = 0; i < 12; ++i) picked.push_back(rule.pick(-2, 8, random));
  EXPECT_EQ(picked, (std::vector<int64_t>{-2, 3, 8, -2, -2, 3, 8, -1, -2, 3, 8, 0}));
}

TEST(FieldRule, RepeatsATermOfARun) {
  Random random(1);
  FieldRule rule = FieldRule::from(Json::parse(R"({"of": [{"run": [3, "max"]}, 4]})"));
  for (const int64_t expected : {9, 9, 9, 4, 9}) EXPECT_EQ(rule.pick(0, 9, random), expected);
}

TEST(FieldRule, StaysInItsInterval) {
  Random random(5);
  FieldRule whole;
  FieldRule part = FieldRule::from(Json::parse("[-1, 1]"));
  std::vector<bool> met(5);
  for (int i = 0; i < 500; ++i) {
    const int64_t value = whole.pick(-2, 2, random);
    ASSERT_TRUE(value >= -2 && value <= 2);
    met[static_cast<size_t>(value + 2)] = true;
    const int64_t narrow = part.pick(-100, 100, random);
    ASSERT_TRUE(narrow >= -1 && narrow <= 1);
  }
  EXPECT_EQ(met, std::vector<bool>(5, true));
}

TEST(FieldRule, RefusesOtherWords) {
  for (const char* text : {R"("some")", "[1]", "1.5", R"({"of": []})", "null"}) {
    EXPECT_THROW(FieldRule::from(Json::parse(text)), std::exception) << text;
  }
}

// The table of LVL-1, one field at a time at its limit and one above it.
TEST(ConformanceLevel, EachLimitOfTheTable) {
  StreamHeader least;
  const auto level_with = [&](auto change) {
    StreamHeader header = least;
    header.window = 0;
    change(header);
    return conformance_level(header);
  };
  EXPECT_EQ(level_with([](StreamHeader&) {}), 0);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.rows = 16; }), 0);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.rows = 17; }), 1);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.cols = 65; }), 2);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.cols = 257; }), 3);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.width = 257; }), 1);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.height = 2049; }), 2);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.height = 8193; }), 3);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.width = 128, h.height = 128; }), 0);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.width = 128, h.height = 129; }), 1);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.width = 2048, h.height = 1025; }), 2);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.width = 8192, h.height = 4097; }), 3);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.depth = 9; }), 1);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.depth = 11; }), 2);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.window = 32; }), 1);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.window = 64; }), 2);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.tree_height = 4; }), 1);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.tree_height = 7; }), 2);
  EXPECT_EQ(level_with([](StreamHeader& h) { h.tree_height = 9; }), 3);
}

}  // namespace
}  // namespace hmlfc::vectors
