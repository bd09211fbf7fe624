// Feeds a fuzz target with mutated seeds: a plain, repeatable driver for compilers without libFuzzer.
//
//   deck_fuzz [--seconds S] [--runs N] [--seed K] [--out DIR] CORPUS...
//
// CORPUS are files or folders of seeds. An input that makes the target throw, crash or take longer than ten seconds is
// saved as DIR/crash-<target> and ends the run with exit code 1; give that file as the only CORPUS with --runs 0 to see
// it again.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largestInput = 1U << 16U;
constexpr unsigned longestRun = 10;  // s

std::string currentInput;
std::string crashFile = "crash";

void saveInput() {
  if (std::FILE* file = std::fopen(crashFile.c_str(), "wb")) {
    std::fwrite(currentInput.data(), 1, currentInput.size(), file);
    std::fclose(file);
  }
  std::fprintf(stderr, "the input is saved as %s\n", crashFile.c_str());
}

void onSignal(int signal) {
  std::fprintf(stderr, "signal %d (%s)\n", signal, signal == SIGALRM ? "the target takes too long" : "crash");
  saveInput();
  _exit(1);
}

void runOnce(const std::string& input) {
  currentInput = input;
  alarm(longestRun);
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "an exception got out: %s\n", error.what());
    saveInput();
    std::exit(1);
  }
  alarm(0);
}

class Mutator {
 public:
  Mutator(std::vector<std::string> seeds, std::uint64_t seed) : seeds_(std::move(seeds)), engine_(seed) {}

  std::string next() {
    std::string text = seeds_[below(seeds_.size())];
    const std::size_t edits = 1 + below(6);
    for (std::size_t i = 0; i < edits; ++i) edit(text);
    if (text.size() > largestInput) text.resize(largestInput);
    return text;
  }

 private:
  std::size_t below(std::size_t n) {
    return n == 0 ? 0 : std::uniform_int_distribution<std::size_t>(0, n - 1)(engine_);
  }

  void edit(std::string& text) {
    static const std::vector<std::string> words{":",    ": ",    "\n",
                                                "- ",   "[",     "]",
                                                "{",    "}",     ",",
                                                "\"",   "'",     "#",
                                                "&a ",  "*a",    "!!int ",
                                                "|\n",  "---",   "null",
                                                "~",    "nan",   ".inf",
                                                "-1",   "1e999", "1e-999",
                                                "0",    "%",     " m/s",
                                                "^2",   "(",     ")",
                                                "degC", "\t",    "\r",
                                                "\\x",  "??",    "<<",
                                                "\xc3", "\xff",  "99999999999999999999",
                                                "true", "\0",    "@",
                                                "`",    ">-",    "? ",
                                                "1/",   "[[[[",  "a.b",
                                                "/",    "(+M)",  "+M",
                                                "=",    "=>",    "END\n",
                                                "!",    "DUP\n", " REV/1 0 0/\n"};
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = std::min(below(1U << below(8)) + 1, text.size() - at);
    switch (below(8)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, words[below(words.size())]);
        break;
      case 3:
        text.replace(at, length, words[below(words.size())]);
        break;
      case 4:  // repeat a piece elsewhere
        text.insert(below(text.size() + 1), text.substr(at, length));
        break;
      case 5: {  // a piece of another seed
        const std::string& other = seeds_[below(seeds_.size())];
        const std::size_t from = below(other.size() + 1);
        text.insert(at, other.substr(from, below(200)));
        break;
      }
      case 6: {  // repeat a whole line
        const std::size_t start = text.rfind('\n', at);
        const std::size_t from = start == std::string::npos ? 0 : start + 1;
        text.insert(from, text.substr(from, text.find('\n', from) - from) + "\n");
        break;
      }
      default:
        if (below(20) == 0) text.resize(at);
        break;
    }
  }

  std::vector<std::string> seeds_;
  std::mt19937_64 engine_;
};

std::string readFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> readCorpus(const std::vector<fs::path>& places) {
  std::vector<fs::path> files;
  for (const fs::path& place : places) {
    if (fs::is_directory(place)) {
      for (const auto& entry : fs::directory_iterator(place)) files.push_back(entry.path());
    } else {
      files.push_back(place);
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const fs::path& file : files) seeds.push_back(readFile(file));
  return seeds;
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 5.0;
  long runs = -1;
  std::uint64_t seed = 1;
  fs::path out = ".";
  std::vector<fs::path> corpus;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--seconds" && more) {
      seconds = std::atof(argv[++i]);
    } else if (word == "--runs" && more) {
      runs = std::atol(argv[++i]);
    } else if (word == "--seed" && more) {
      seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (word == "--out" && more) {
      out = argv[++i];
    } else {
      corpus.emplace_back(word);
    }
  }
  std::vector<std::string> seeds = readCorpus(corpus);
  if (seeds.empty()) {
    std::cerr << "no seeds: name a corpus\n";
    return 2;
  }
  crashFile = (out / ("crash-" + fs::path(argv[0]).filename().string())).string();
  std::signal(SIGALRM, onSignal);
  if (__sanitizer_set_death_callback != nullptr) {
    __sanitizer_set_death_callback(saveInput);
  } else {
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) std::signal(signal, onSignal);
  }

  for (const std::string& text : seeds) runOnce(text);
  Mutator mutator(seeds, seed);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  long done = 0;
  while (runs >= 0 ? done < runs : std::chrono::steady_clock::now() < end) {
    runOnce(mutator.next());
    ++done;
  }
  std::cout << fs::path(argv[0]).filename().string() << ": " << seeds.size() << " seeds and " << done
            << " mutated inputs, no failure\n";
  return 0;
}
