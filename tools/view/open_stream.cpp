#include "view/open_stream.hpp"

#include "cli/output.hpp"

namespace hmlfc::view {

using cli::ExitCode;
using cli::Failure;
using cli::StreamFile;

OpenStream::OpenStream(const std::filesystem::path& file, const std::filesystem::path& original,
                       const io::ViewNaming& naming)
    : path_(file) {
  open(cli::open_source(file));
  if (original.empty()) return;
  original_ = cli::ViewSource::open(original, naming);
  if (!std::filesystem::is_directory(original)) twin_ = std::make_unique<OpenStream>(original);
  if (for_blocks_ == nullptr) return;
  const LightFieldShape shape = cli::shape_of(for_blocks_->header());
  if (original_->shape() == shape) return;
  throw Failure(ExitCode::kInput, "--original: " + original.string() + " has " +
                                      cli::describe(original_->shape()) + ", but " + file.string() +
                                      " has " + cli::describe(shape) +
                                      "; it takes a folder or a stream of the same views");
}

OpenStream::OpenStream(const std::filesystem::path& name, std::span<const uint8_t> bytes)
    : path_(name) {
  open(std::make_shared<const remote::OpenSource>(
      remote::OpenSource{std::make_unique<MemorySource>(bytes)}));
}

void OpenStream::open(const std::shared_ptr<const remote::OpenSource>& source) {
  touched_ = std::make_unique<FrameReads>(source->bytes->bytes().size());
  OpenOptions options{.check_sections = false};
  try {
    for_blocks_ = std::make_unique<StreamFile>(path_, source, options);
    options.reads = touched_.get();
    for_frames_ = std::make_unique<StreamFile>(path_, source, options);
  } catch (const Failure& failure) {
    const std::filesystem::path extension = path_.extension();
    const bool is_other =
        failure.code() == ExitCode::kInput && !extension.empty() && extension != ".hmlfc";
    if (failure.code() == ExitCode::kOutOfMemory || is_other) throw;
    error_ = failure.what();
    return;
  }
  const auto checked = for_blocks_->check_sections();
  if (!checked) warning_ = path_.string() + ": " + to_string(checked.error());
}

const StreamFile& OpenStream::opened(const std::unique_ptr<StreamFile>& file) const {
  if (file == nullptr) throw Failure(ExitCode::kCorrupt, error_);
  return *file;
}

}  // namespace hmlfc::view
