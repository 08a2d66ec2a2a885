#include "conform/command_template.hpp"

#include <optional>

namespace hmlfc::conform {
namespace {

// Reads words one after the other.
class WordReader {
 public:
  explicit WordReader(std::string_view text) : text_(text) {}

  // The next word; nothing at the end of the text or where a quote does not end.
  std::optional<std::string> next() {
    at_ = std::min(text_.find_first_not_of(" \t\n", at_), text_.size());
    if (at_ == text_.size()) return std::nullopt;
    std::string word;
    char quote = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == quote && quote != 0) {
        quote = 0;
      } else if (quote == 0 && (c == '"' || c == '\'')) {
        quote = c;
      } else if (c == '\\' && quote != '\'' && at_ + 1 < text_.size()) {
        word += text_[++at_];
      } else if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
        break;
      } else {
        word += c;
      }
    }
    unfinished_ = quote != 0;
    if (unfinished_) return std::nullopt;
    return word;
  }

  bool unfinished() const { return unfinished_; }

 private:
  std::string_view text_;
  size_t at_ = 0;
  bool unfinished_ = false;
};

}  // namespace

io::IoResult<std::vector<std::string>> split_command(std::string_view text) {
  WordReader reader(text);
  std::vector<std::string> words;
  while (auto word = reader.next()) words.push_back(std::move(*word));
  if (reader.unfinished()) {
    return io::file_error(std::string(text), "a quote of this command line has no end");
  }
  if (words.empty()) return tl::unexpected(io::IoError{"the command line is empty"});
  return words;
}

std::vector<std::string> fill_in(const std::vector<std::string>& words, const Places& places) {
  std::vector<std::string> filled;
  for (const std::string& word : words) {
    std::string text;
    for (size_t at = 0; at < word.size();) {
      const size_t end = word[at] == '{' ? word.find('}', at) : std::string::npos;
      const auto place = end == std::string::npos
                             ? places.end()
                             : places.find(std::string_view(word).substr(at + 1, end - at - 1));
      if (place != places.end()) {
        text += place->second;
        at = end + 1;
      } else {
        text += word[at++];
      }
    }
    filled.push_back(std::move(text));
  }
  return filled;
}

}  // namespace hmlfc::conform
