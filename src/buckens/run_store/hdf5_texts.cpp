// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_texts.h"

#include <array>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/isolated_work.h"

namespace buckens::run_store {

namespace {

void put_number(std::string& out, std::uint64_t number) {
  std::array<char, sizeof number> bytes;
  std::memcpy(bytes.data(), &number, sizeof number);
  out.append(bytes.data(), bytes.size());
}

void put_text(std::string& out, const std::string& text) {
  put_number(out, text.size());
  out += text;
}

/// Decodes the message; the other process may have written nonsense.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : rest_(bytes) {}

  bool at_end() const { return rest_.empty(); }

  std::uint64_t number() {
    std::uint64_t out = 0;
    const std::string_view bytes = take(sizeof out);
    std::memcpy(&out, bytes.data(), sizeof out);
    return out;
  }

  std::string text() { return std::string(take(number())); }

 private:
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size())
      throw IoError("the process that reads texts returned an invalid answer.");
    const std::string_view out = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return out;
  }

  std::string_view rest_;
};

std::string reason(int signal) {
  if (signal == SIGXCPU) return "runs in circles";
  return signal == 0 ? "breaks off" : fmt::format("breaks off with signal {}", signal);
}

}  // namespace

const Hdf5Texts::Entry* Hdf5Texts::find(const std::string& place) const {
  const auto at = entries_.find(place);
  return at == entries_.end() ? nullptr : &at->second;
}

std::string Hdf5Texts::packed() const {
  std::string out;
  for (const auto& [place, entry] : entries_) {
    put_text(out, place);
    put_text(out, entry.error);
    put_number(out, entry.texts.size());
    for (const std::string& text : entry.texts) put_text(out, text);
  }
  return out;
}

Hdf5Texts Hdf5Texts::unpacked(const std::string& bytes) {
  Hdf5Texts out;
  Unpacker source(bytes);
  while (!source.at_end()) {
    const std::string place = source.text();
    Entry entry{{}, source.text()};
    for (std::uint64_t left = source.number(); left > 0; --left) {
      entry.texts.push_back(source.text());
    }
    out.entries_[place] = std::move(entry);
  }
  out.is_complete_ = true;
  return out;
}

std::shared_ptr<Hdf5Texts> read_texts_apart(
    const std::filesystem::path& file,
    const std::function<void(const std::shared_ptr<Hdf5Texts>&)>& read) {
  constexpr unsigned kSeconds = 60;  // it reads bookkeeping, never the records themselves
  const files::IsolatedResult apart = files::do_isolated(
      [&read] {
        const auto texts = std::make_shared<Hdf5Texts>();
        try {
          read(texts);
        } catch (...) {  // will occur again where it is expected
        }
        return texts->packed();
      },
      kSeconds);
  if (!apart.is_complete) {
    throw IoError(
        fmt::format("{}: the file is damaged: HDF5 {} while reading it. Run the model again.",
                    file.string(), reason(apart.signal)));
  }
  return std::make_shared<Hdf5Texts>(Hdf5Texts::unpacked(apart.output));
}

}  // namespace buckens::run_store
