// Programs that are run within limits: a job of Windows ends all that comes of one.
#include "conform/process.hpp"

#include <windows.h>

#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <mutex>
#include <system_error>

#include <fmt/format.h>

#include "names.hpp"

namespace hmlfc::conform {
namespace {

using Clock = std::chrono::steady_clock;
using io::FileDescriptor;

constexpr size_t kMessageBytes = 8192;
constexpr DWORD kOften = 5;  // milliseconds from one look at the pipes to the next

// A program, and the job that ends it and what it has started.
struct Child {
  HANDLE process;
  HANDLE job;
};

// By the number that Process::reaper_ has.
std::map<pid_t, Child> children;
std::mutex children_mutex;

Child child_of(pid_t number) {
  const std::lock_guard lock(children_mutex);
  return children.at(number);
}

FileDescriptor descriptor_of(HANDLE handle) {
  return FileDescriptor(::_open_osfhandle(reinterpret_cast<intptr_t>(handle), _O_BINARY));
}

struct Pipe {
  HANDLE read = nullptr;
  HANDLE write = nullptr;
};

// A pipe of which a program inherits the one end and this process keeps the other.
Pipe make_pipe(HANDLE Pipe::*kept) {
  SECURITY_ATTRIBUTES inherited = {sizeof(inherited), nullptr, TRUE};
  Pipe pipe;
  if (::CreatePipe(&pipe.read, &pipe.write, &inherited, 0) == 0) {
    throw std::system_error(EMFILE, std::generic_category(), "CreatePipe");
  }
  ::SetHandleInformation(pipe.*kept, HANDLE_FLAG_INHERIT, 0);
  return pipe;
}

// The words as one line, which programs take apart again: a quote has a backslash in front, and so
// has each backslash in front of a quote.
std::string line_of(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    line += line.empty() ? "\"" : " \"";
    size_t backslashes = 0;
    for (const char c : word) {
      if (c == '"') line.append(backslashes + 1, '\\');
      backslashes = c == '\\' ? backslashes + 1 : 0;
      line += c;
    }
    line.append(backslashes, '\\');
    line += '"';
  }
  return line;
}

HANDLE make_job(uint64_t memory_bytes) {
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits = {};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  if (memory_bytes != 0) limits.BasicLimitInformation.LimitFlags |= JOB_OBJECT_LIMIT_JOB_MEMORY;
  limits.JobMemoryLimit = memory_bytes;
  const HANDLE job = ::CreateJobObjectW(nullptr, nullptr);
  ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof(limits));
  return job;
}

// The number of the new program, or -1.
pid_t start(const std::vector<std::string>& command, uint64_t memory_bytes, const Pipe& input,
            const Pipe& output, const Pipe& messages) {
  STARTUPINFOW how = {};
  how.cb = sizeof(how);
  how.dwFlags = STARTF_USESTDHANDLES;
  how.hStdInput = input.read;
  how.hStdOutput = output.write;
  how.hStdError = messages.write;
  std::wstring line = windows::wide(line_of(command));
  PROCESS_INFORMATION started = {};
  // One at a time: no program gets the ends of another's pipes.
  const std::lock_guard lock(children_mutex);
  const BOOL ok = ::CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, CREATE_SUSPENDED,
                                   nullptr, nullptr, &how, &started);
  for (const HANDLE end : {input.read, output.write, messages.write}) ::CloseHandle(end);
  if (ok == 0) return -1;
  const HANDLE job = make_job(memory_bytes);
  ::AssignProcessToJobObject(job, started.hProcess);
  ::ResumeThread(started.hThread);
  ::CloseHandle(started.hThread);
  const auto number = static_cast<pid_t>(started.dwProcessId);
  children[number] = {started.hProcess, job};
  return number;
}

}  // namespace

void Process::Tail::read() {
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(pipe.get()));
  for (DWORD there = 0;
       ::PeekNamedPipe(handle, nullptr, 0, nullptr, &there, nullptr) != 0 && there > 0;) {
    std::string part(std::min<size_t>(there, 65536), '\0');
    const int count = ::_read(pipe.get(), part.data(), static_cast<unsigned>(part.size()));
    if (count <= 0) return;
    text.append(part, 0, static_cast<size_t>(count));
    if (text.size() / 2 > keep) cut();
  }
}

Process::Process(const std::vector<std::string>& command, uint64_t memory_bytes,
                 size_t output_bytes)
    : program_(command.front()),
      begin_(Clock::now()),
      output_{{}, output_bytes},
      messages_{{}, kMessageBytes} {
  const Pipe input = make_pipe(&Pipe::write);
  const Pipe output = make_pipe(&Pipe::read);
  const Pipe messages = make_pipe(&Pipe::read);
  input_ = descriptor_of(input.write);
  output_.pipe = descriptor_of(output.read);
  messages_.pipe = descriptor_of(messages.read);
  reaper_ = start(command, memory_bytes, input, output, messages);
}

Process::Stop Process::exchange(std::string_view text, Time deadline, const Suffices& suffices) {
  if (reaper_ < 0) return Stop::kEnded;
  const HANDLE process = child_of(reaper_).process;
  ::_write(input_.get(), text.data(), static_cast<unsigned>(text.size()));
  for (;;) {
    const bool ended = ::WaitForSingleObject(process, kOften) == WAIT_OBJECT_0;
    output_.read();
    messages_.read();
    if (suffices(output_.text)) return Stop::kSuffices;
    if (ended) return Stop::kEnded;
    if (Clock::now() >= deadline) return Stop::kTimeout;
  }
}

ProcessOutcome Process::end(bool timed_out) {
  ProcessOutcome outcome;
  outcome.program = program_;
  outcome.value = ENOENT;
  if (reaper_ < 0) return outcome;
  const Child child = child_of(reaper_);
  const bool ended = ::WaitForSingleObject(child.process, 0) == WAIT_OBJECT_0;
  ::TerminateJobObject(child.job, 1);
  ::WaitForSingleObject(child.process, INFINITE);
  DWORD status = 0;
  ::GetExitCodeProcess(child.process, &status);
  outcome.end = timed_out                         ? ProcessEnd::kTimeout
                : !ended || status >= 0xC0000000u ? ProcessEnd::kSignal
                                                  : ProcessEnd::kExit;
  outcome.value = static_cast<int>(status);
  outcome.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  output_.read();
  output_.cut();
  outcome.output = std::move(output_.text);
  outcome.messages = take_messages();
  for (const HANDLE handle : {child.process, child.job}) ::CloseHandle(handle);
  const std::lock_guard lock(children_mutex);
  children.erase(std::exchange(reaper_, -1));
  return outcome;
}

std::string to_string(const ProcessOutcome& outcome) {
  switch (outcome.end) {
    case ProcessEnd::kExit:
      return fmt::format("exit status {}", outcome.value);
    case ProcessEnd::kSignal:
      return fmt::format("exception {:#x}", static_cast<unsigned>(outcome.value));
    case ProcessEnd::kTimeout:
      return fmt::format("timed out after {:.1f} s", outcome.seconds);
    case ProcessEnd::kNotStarted:
      return fmt::format("{} cannot be started", outcome.program);
  }
  return {};
}

}  // namespace hmlfc::conform
