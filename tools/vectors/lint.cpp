#include "vectors/examine.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include <hmlfc/stream_info.hpp>

#include "io/files.hpp"
#include "vectors/digest.hpp"

namespace hmlfc::vectors {
namespace {

constexpr std::string_view kLastWord = "ffffffff";

template <class T>
bool has_duplicate(std::vector<T> list) {
  std::sort(list.begin(), list.end());
  return std::adjacent_find(list.begin(), list.end()) != list.end();
}

// Whether a $readmemh text has as many words as its first word says, and then the end marker.
bool is_whole_hex(std::string_view text) {
  std::istringstream lines{std::string(text)};
  std::vector<std::string> words;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line.substr(0, line.find("//")));
    for (std::string word; in >> word;) words.push_back(word);
  }
  if (words.size() < 2 || words.back() != kLastWord) return false;
  size_t count = 0;
  const std::string& first = words.front();
  const auto [end, error] = std::from_chars(first.data(), first.data() + first.size(), count, 16);
  return error == std::errc{} && end == first.data() + first.size() && count == words.size() - 2;
}

// One vector of the suite.
class VectorLint {
 public:
  VectorLint(const std::filesystem::path& folder, const Vector& vector,
             std::set<std::string>& named, std::vector<std::string>& found)
      : folder_(folder), vector_(vector), named_(named), found_(found) {}

  void run() {
    check_names();
    const auto input = read(vector_.input);
    if (!input) return;
    if (input->bytes().size() != vector_.input.bytes) complain("the input has another length");
    check_stream(input->bytes());
    if (vector_.blocks) check_blocks();
    if (vector_.trace) check_trace(*vector_.trace);
  }

 private:
  void complain(const std::string& what) { found_.push_back(vector_.id.text() + ": " + what); }

  void check_names() {
    if (!vector_.id.text().starts_with(vector_.group + "/"))
      complain("is not named after its group");
    if (vector_.clauses.empty()) complain("names no clause");
    if (has_duplicate(vector_.clauses)) complain("names a clause twice");
    if (has_duplicate(vector_.flags)) complain("has a flag twice");
    if (vector_.comment.empty()) complain("has no comment");
    if ((vector_.group == "error") == (vector_.expect.outcome == Outcome::kOk)) {
      complain("its group contradicts its outcome");
    }
  }

  // The file, if its sum is that of the manifest; otherwise nothing, and a complaint.
  std::optional<MappedFile> read(const SuiteFile& file) {
    named_.insert(file.file.text());
    auto mapped = io::map_file(folder_ / file.file);
    if (!mapped) {
      complain(mapped.error().message);
      return std::nullopt;
    }
    if (sha256(mapped->bytes()) != file.sha256)
      complain(file.file.text() + ": the SHA-256 differs");
    return std::move(*mapped);
  }

  void check_stream(std::span<const uint8_t> bytes) {
    const auto header = parse_header(bytes);
    const Expectation& expect = vector_.expect;
    const bool opens = expect.outcome == Outcome::kOk || expect.operation == Operation::kBlock;
    const auto opened = Decoder::open(bytes);
    if (opens && !opened) complain("does not open: " + to_string(opened.error()));
    if (!opens && opened) complain("opens");
    if (!opens && !opened && opened.error().code != expect.error) {
      complain("does not open, but for another reason: " + to_string(opened.error()));
    }
    if (!header) return;
    header_ = *header;
    if (header->profile != vector_.profile) complain("is of the other profile");
    if (conformance_level(*header) != vector_.level) complain("is of another conformance level");
    if (vector_.output) check_output(*header, *vector_.output);
  }

  void check_output(const StreamHeader& header, const ViewSum& output) {
    const bool same = output.rows == header.rows && output.cols == header.cols &&
                      output.width == header.width && output.height == header.height &&
                      output.depth == header.depth && output.chroma == header.chroma_format;
    if (!same) complain("output has another shape than the header says");
  }

  void check_blocks() {
    const auto file = read(*vector_.blocks);
    if (!file || !header_) return;
    const auto bytes = file->bytes();
    const size_t lines = static_cast<size_t>(std::count(bytes.begin(), bytes.end(), '\n'));
    if (lines != size_t{2} * header_->rows * header_->cols) {
      complain("the blocks file does not have two lines per view");
    }
  }

  void check_trace(const TraceFiles& trace) {
    read(trace.lines);
    const auto hex = read(trace.hex);
    if (!hex) return;
    const auto bytes = hex->bytes();
    if (!is_whole_hex({reinterpret_cast<const char*>(bytes.data()), bytes.size()})) {
      complain(trace.hex.file.text() + ": count or end marker is wrong");
    }
  }

  const std::filesystem::path& folder_;
  const Vector& vector_;
  std::set<std::string>& named_;
  std::vector<std::string>& found_;
  std::optional<StreamHeader> header_;
};

// Files in the folders of the groups that no vector names.
void find_strays(const std::filesystem::path& folder, const Manifest& manifest,
                 const std::set<std::string>& named, std::vector<std::string>& found) {
  std::set<std::string> groups;
  for (const Vector& vector : manifest.vectors) groups.insert(vector.group);
  for (const std::string& group : groups) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder / group, error)) {
      const std::string name = group + "/" + entry.path().filename().string();
      if (!named.contains(name)) found.push_back(name + ": no vector names this file");
    }
  }
}

}  // namespace

std::vector<std::string> lint_suite(const std::filesystem::path& folder, const Manifest& manifest) {
  std::vector<std::string> found;
  std::set<std::string> named;
  const VectorId* before = nullptr;
  for (const Vector& vector : manifest.vectors) {
    if (before != nullptr && *before >= vector.id) {
      found.push_back(vector.id.text() + ": ids are not sorted, or not unique");
    }
    before = &vector.id;
    VectorLint(folder, vector, named, found).run();
  }
  for (const Vector& frame : manifest.frames) {
    const auto stream = io::map_file(folder / frame.input.file);
    const auto header =
        stream ? parse_header(stream->bytes()) : fail(ErrorCode::kTruncated, Section::kHeader, 0);
    if (header && sha256(stream->bytes()) == frame.input.sha256 &&
        is_of_stream(*frame.frame, *header)) {
      continue;
    }
    found.push_back(frame.id.text() + ": asks for what its stream does not have");
  }
  find_strays(folder, manifest, named, found);
  return found;
}

}  // namespace hmlfc::vectors
