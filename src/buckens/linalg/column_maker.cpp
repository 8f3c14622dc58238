// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/column_maker.h"

#include "buckens/linalg/column_content.h"
#include "buckens/linalg/finite_matrix.h"
#include "buckens/linalg/told_errors.h"

namespace buckens::linalg {

namespace {

MakeColumns the_maker = nullptr;
SparseMatrix last_columns;

int make_some(const void* bytes, long count, int first, int end, BuckensGridColumns* columns,
              char* error, int error_size) {
  SparseMatrix().swap(last_columns);  // an assignment would keep the memory
  if (columns == nullptr) return 0;
  constexpr char kNoRoom[] = "there is too little memory for making the rows of the matrix";
  return told_errors(error, error_size, kNoRoom, [&] {
    const std::span description(static_cast<const std::byte*>(bytes),
                                static_cast<std::size_t>(count));
    SparseMatrix made = the_maker(description, first, end);
    require_finite(made, first);
    made.makeCompressed();
    last_columns.swap(made);
    *columns = {last_columns.outerIndexPtr(), last_columns.innerIndexPtr(),
                last_columns.valuePtr()};
  });
}

void add_content_of(int count, const BuckensGridColumns* columns, const int* variables,
                    unsigned long long* content) {
  std::array<std::uint64_t, 2> sum{};
  for (int k = 0; k < count; ++k) {
    for (int e = columns->starts[k]; e < columns->starts[k + 1]; ++e) {
      add_content(variables[columns->rows[e]], variables[k], columns->values[e], sum);
    }
  }
  for (std::size_t k = 0; k < sum.size(); ++k) content[k] += sum[k];
}

}  // namespace

BuckensGridMaker column_maker(MakeColumns make) {
  the_maker = make;
  BuckensGridMaker out{};
  out.make = make_some;
  out.add_content = add_content_of;
  return out;
}

}  // namespace buckens::linalg
