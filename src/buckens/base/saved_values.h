// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace buckens::base {

/// Numbers of an open file. Several threads may read them.
class NumbersInFile {
 public:
  virtual ~NumbersInFile() = default;
  /// @throws IoError if the file has changed, or cannot be read
  virtual void read(std::size_t first, std::span<double> to) const = 0;
  virtual void read(std::size_t first, std::span<float> to) const = 0;

 protected:
  NumbersInFile() = default;
  NumbersInFile(const NumbersInFile&) = default;
  NumbersInFile& operator=(const NumbersInFile&) = default;
};

/// Named lists of numbers and strings that make up a saved state. Names are paths, such as
/// "state/bodies/0/d".
struct SavedValues {
  /// Numbers in single precision that are not there yet.
  struct Later {
    std::size_t size = 0;
    std::function<Eigen::VectorXf()> make;
  };

  /// Numbers that are read when a visit asks for them. The file is open as long as there are any.
  struct InFile {
    std::shared_ptr<const NumbersInFile> file;
    std::size_t first = 0, size = 0;

    template <class Number>
    void read(std::span<Number> to) const {
      file->read(first, to);
    }
  };

  std::map<std::string, std::vector<double>> numbers;
  /// More of these.
  std::map<std::string, InFile> in_file;
  /// Numbers that single precision holds exactly, in half of the memory. Files have them among
  /// `numbers`.
  std::map<std::string, std::vector<float>> singles;
  /// The same, made list by list as they are written: only while what they come from is as it was.
  std::map<std::string, Later> later;
  std::map<std::string, std::vector<std::int64_t>> counts;
  std::map<std::string, std::vector<std::string>> texts;

  /// The lists whose names begin so, in memory. @pre nothing comes later @throws IoError
  SavedValues part(const std::string& beginning) const;
  /// The same lists, wherever they are. @pre nothing comes later @throws IoError
  bool operator==(const SavedValues& other) const;
};

/// Visits the members of an object to save or restore. Each member is named only once, so that
/// writing and reading cannot differ.
///
/// When restoring, lengths and ranges of a list are checked before anything is changed, and its
/// length before it is read.
/// @throws InputError naming a value that is missing or invalid, IoError if its file cannot be read
class SaveVisit {
 public:
  static SaveVisit saving(SavedValues& out) { return {&out, nullptr, "", false}; }
  /// Long lists come later, to spare memory.
  static SaveVisit saving_to_write(SavedValues& out) { return {&out, nullptr, "", true}; }
  static SaveVisit restoring(const SavedValues& from) { return {nullptr, &from, "", false}; }

  bool is_restoring() const { return from_ != nullptr; }
  /// The same, with a name.
  SaveVisit inside(const std::string& name) const;
  SaveVisit inside(std::size_t index) const { return inside(std::to_string(index)); }

  void number(const std::string& name, double& value) const;
  void flag(const std::string& name, bool& value) const;
  /// @param least,most inclusive range of the value
  void count(const std::string& name, long& value, long least, long most) const;
  void count(const std::string& name, int& value, int least, int most) const;
  /// An array whose length is fixed.
  void numbers(const std::string& name, std::span<double> values) const;
  /// A matrix or vector of fixed size.
  template <int rows, int columns>
  void fixed(const std::string& name, Eigen::Matrix<double, rows, columns>& value) const {
    numbers(name, {value.data(), static_cast<std::size_t>(value.size())});
  }
  void rotation(const std::string& name, Eigen::Quaterniond& q) const;
  /// A vector that must have this size when restored.
  void vector(const std::string& name, Eigen::VectorXd& value, Eigen::Index size) const;
  /// The same for a vector that may also be empty.
  void vector_or_none(const std::string& name, Eigen::VectorXd& value, Eigen::Index size) const;
  /// A vector in single precision, which its owner makes to be saved, and takes when restored.
  void save_singles(const std::string& name, Eigen::Index size,
                    std::function<Eigen::VectorXf()> make) const;
  Eigen::VectorXf restored_singles(const std::string& name, Eigen::Index size) const;
  void list(const std::string& name, std::vector<double>& values, std::size_t size) const;
  /// The same for a list that may also be empty, or contain NaN for missing values.
  void list_or_none(const std::string& name, std::vector<double>& values, std::size_t size) const;
  /// A list of any length. @param least,most inclusive range of the entries
  void counts(const std::string& name, std::vector<int>& values, int least, int most) const;
  void counts(const std::string& name, std::vector<long>& values, long least, long most) const;
  /// A list of any length.
  void any_numbers(const std::string& name, std::vector<double>& values) const;
  void texts(const std::string& name, std::vector<std::string>& values) const;

  /// @throws InputError "the saved <path>: <what>"
  [[noreturn]] void refuse(const std::string& name, const std::string& what) const;

 private:
  SaveVisit(SavedValues* out, const SavedValues* from, std::string prefix, bool makes_later)
      : out_(out), from_(from), prefix_(std::move(prefix)), makes_later_(makes_later) {}
  /// Of a list of numbers that is restored.
  std::size_t length_of(const std::string& name) const;
  /// The list in memory of its own.
  template <class List>
  List restored(const std::string& name) const;
  /// The same for a list of finite numbers that must have this size.
  template <class List>
  List restored(const std::string& name, std::size_t size) const;

  SavedValues* out_;
  const SavedValues* from_;
  std::string prefix_;
  bool makes_later_;
};

}  // namespace buckens::base
