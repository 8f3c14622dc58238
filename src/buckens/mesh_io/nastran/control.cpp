// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/control.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/number.h"

namespace buckens::mesh_io {

namespace {

constexpr std::array<std::string_view, 24> kStatements = {
    "SOL",   "CEND",    "ID",   "TIME",         "NASTRAN",  "ASSIGN",    "INIT", "DIAG",
    "TITLE", "SUBCASE", "ECHO", "DISPLACEMENT", "SUBTITLE", "LABEL",     "SPC",  "METHOD",
    "LOAD",  "STRESS",  "DISP", "ANALYSIS",     "RESTART",  "GEOMCHECK", "SET",  "PROJ"};

/// The words of a line in upper case; commas, equal signs and brackets stand apart from words.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> out;
  std::string word;
  const auto finish = [&] {
    if (!word.empty()) out.push_back(upper_case(word));
    word.clear();
  };
  for (const char c : text) {
    if (c == ' ' || c == '\t' || c == '\r') {
      finish();
    } else if (c == ',' || c == '=' || c == '(' || c == ')') {
      finish();
      out.emplace_back(1, c);
    } else {
      word += c;
    }
  }
  finish();
  return out;
}

/// Whether a line is BEGIN BULK, with blanks or a comma between. A BEGIN alone is the start of a
/// DMAP program, which ends before CEND.
bool is_begin(std::string_view text) {
  text = trimmed(text);
  constexpr std::size_t kMostLength = 200;
  if (text.size() < 5 || upper_case(text.substr(0, 5)) != "BEGIN") return false;
  const std::vector<std::string> words = words_of(text.substr(0, kMostLength));
  return words.size() > 1 && words[0] == "BEGIN" && words[1] != "$";
}

bool has_begin_line(std::string_view text) {
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (is_begin(text.substr(begin, end - begin))) return true;
    begin = end + 1;
  }
  return false;
}

bool is_statement(std::string_view text) {
  // A card of the bulk data has blanks up to column 8, or a comma behind its name.
  const std::string head = upper_case(trimmed(text).substr(0, 80));
  const std::size_t end = head.find_first_of(" \t=(");
  const std::string word = head.substr(0, end);
  if (word == "SPC" || word == "LOAD" || word == "SET" || word == "STRESS") {
    return head.find('=') != std::string::npos;
  }
  return std::find(kStatements.begin(), kStatements.end(), word) != kStatements.end();
}

/// Collects `SET n = 1, 2 THRU 9 EXCEPT 5, 20`, which goes on after a comma at the end of a line.
class SetStatement {
 public:
  bool is_open() const { return open_; }

  /// Takes a line that may start a set; sets of other things than numbers are passed over.
  bool start(const std::vector<std::string>& words, const NastranLine& line) {
    if (words.size() < 4 || words[0] != "SET" || words[2] != "=") return false;
    const auto id = nastran_integer(words[1]);
    if (!id) return false;
    set_ = NastranControlSet{*id, false, {}, {}, line.file, line.number};
    usable_ = true;
    thru_ = except_ = ranging_ = false;
    add(words, 3);
    return true;
  }

  void add(const std::vector<std::string>& words, std::size_t from) {
    open_ = !words.empty() && words.back() == ",";
    for (std::size_t i = from; i < words.size(); ++i) add(words[i]);
  }

  /// The finished set; empty if it holds anything but whole numbers.
  std::optional<NastranControlSet> take() {
    if (!usable_ || thru_) return std::nullopt;
    return set_;
  }

 private:
  void add(const std::string& word) {
    if (word == ",") return;
    if (word == "ALL") {
      set_.all = true;
    } else if (word == "THRU") {
      usable_ = usable_ && !set_.members.empty();
      thru_ = true;
    } else if (word == "EXCEPT") {
      except_ = true;
    } else if (const auto number = nastran_integer(word)) {
      add(*number);
    } else {
      usable_ = false;
    }
  }

  void add(std::int64_t number) {
    if (thru_) {
      // A set that begins with THRU is not usable.
      ranging_ = !set_.members.empty();
      if (ranging_) set_.members.back().last = number;
      thru_ = false;
      return;
    }
    // What EXCEPT takes out lies in the range before; the first number beyond it is a member again.
    if (except_ && ranging_ && number > set_.members.back().last) except_ = false;
    if (except_) {
      set_.except.push_back({number, number});
    } else {
      set_.members.push_back({number, number});
      ranging_ = false;
    }
  }

  NastranControlSet set_;
  bool open_ = false, usable_ = false, thru_ = false, except_ = false, ranging_ = false;
};

/// `MPC = n` or `NSM = n`, one for all subcases.
void read_choice(const std::vector<std::string>& words, const NastranLine& line,
                 const char* keyword, const char* what, std::optional<std::int64_t>& choice) {
  if (words.size() < 3 || words[0] != keyword || words[1] != "=") return;
  const auto id = nastran_integer(words[2]);
  if (!id) return;
  if (choice && *choice != *id) {
    throw InputError({line.file->name, line.number, 1},
                     fmt::format("{} = {}: another subcase asks for {} = {}; a body has one set "
                                 "of {}, keep one of them",
                                 keyword, *id, keyword, *choice, what));
  }
  choice = *id;
}

/// Matrices that add mass, stiffness or both to the structure.
void read_matrix_choice(const std::vector<std::string>& words, const NastranLine& line,
                        NastranControl& control) {
  constexpr std::array<std::string_view, 5> keywords = {"K2GG", "M2GG", "K2PP", "M2PP", "K42GG"};
  if (words.size() < 3 || words[1] != "=" ||
      std::find(keywords.begin(), keywords.end(), words[0]) == keywords.end()) {
    return;
  }
  control.matrices.push_back({words[0], words[2], line.file, line.number});
}

void read_parameter(const std::vector<std::string>& words, const NastranLine& line,
                    NastranControl& control) {
  if (words.size() < 5 || words[0] != "PARAM" || words[2] != "WTMASS") return;
  control.weight_to_mass = nastran_real(words[4]);
  if (control.weight_to_mass && *control.weight_to_mass > 0) return;
  throw InputError(
      {line.file->name, line.number, 1},
      fmt::format("PARAM,WTMASS: {} is not a positive number", quoted_excerpt(words[4])));
}

}  // namespace

bool has_nastran_bulk_data(std::string_view text) { return has_begin_line(text); }

NastranControl read_nastran_control(NastranSource& source,
                                    std::optional<NastranLine>& first_bulk_line) {
  constexpr std::size_t kMostLength = 4096;
  NastranControl control;
  std::optional<NastranLine> line = source.next();
  control.present = has_begin_line(source.main_file().text) || (line && is_statement(line->text));
  if (!control.present) {
    first_bulk_line = line;
    return control;
  }
  SetStatement set;
  const auto finish_set = [&] {
    if (auto done = set.take()) control.sets.push_back(std::move(*done));
  };
  for (; line; line = source.next()) {
    if (is_begin(line->text)) return control;
    ++control.num_lines;
    const std::vector<std::string> words = words_of(line->text.substr(0, kMostLength));
    if (set.is_open()) {
      set.add(words, 0);
      if (!set.is_open()) finish_set();
    } else if (set.start(words, *line)) {
      if (!set.is_open()) finish_set();
    } else {
      read_choice(words, *line, "MPC", "equations", control.mpc_set);
      read_choice(words, *line, "NSM", "non-structural masses", control.nsm_set);
      read_matrix_choice(words, *line, control);
      read_parameter(words, *line, control);
    }
  }
  throw InputError(
      {source.main_file().name, 0, 0},
      "there is executive or case control, but no BEGIN BULK after it; the deck may be truncated");
}

}  // namespace buckens::mesh_io
