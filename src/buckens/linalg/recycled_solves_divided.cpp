// SPDX-License-Identifier: Apache-2.0
// Answers to loads of which other processes have the rows: they work on them, and on the pairs.
#include <array>
#include <cmath>

#include "buckens/linalg/recycled_solves.h"

namespace buckens::linalg {

namespace {

Vector run_for(RowProgram& program, const RowProgram::Sums& sums) {
  program.run();
  return program.sum(sums);
}

}  // namespace

/// Takes from the remainder what lies along the pairs. @param products of the remainder with them
void RecycledSolves::project_divided(Request& request, RowProgram& program,
                                     const Vector& products) const {
  program.subtract_loads(pairs_there(0, num_pairs()), request.remainder_there, products);
  request.weights.head(num_pairs()) += products;
}

bool RecycledSolves::answer(const DividedLoad& f, double limit, Request& request) {
  request.fate = Request::Fate::not_tried;
  request.of = f.of;
  if (!may_answer()) return false;
  const RowProgram::Pairs all = pairs_there(0, num_pairs());
  request.weights.setZero(most_);
  Vector products;
  {
    RowProgram program(*f.of);
    request.remainder_there = program.scale(*f.load, *f.scale, false);
    products = run_for(program, program.pair_products(all, request.remainder_there));
  }
  {
    // What is left is judged together with forming the answer that there is if it is little.
    RowProgram program(*f.of);
    project_divided(request, program, products);
    const RowProgram::Sums square = program.square(request.remainder_there);
    const DividedVector sum = program.combine_answers(all, request.weights.head(num_pairs()));
    const DividedVector answered = program.scale(sum, *f.scale, false);
    if (std::sqrt(run_for(program, square)[0]) <= limit) {
      *f.load = answered;
      request.fate = Request::Fate::answered;
      return true;
    }
  }
  // Once more: what rounding has left along the pairs must not come into the next one.
  RowProgram again(*f.of);
  products = run_for(again, again.pair_products(all, request.remainder_there));
  RowProgram program(*f.of);
  project_divided(request, program, products);
  *f.load = program.scale(request.remainder_there, *f.scale, true);
  program.run();
  request.fate = Request::Fate::solved;
  return false;
}

void RecycledSolves::complete(Request& request, const DividedLoad& x) const {
  if (request.fate != Request::Fate::solved) return;
  RowProgram program(*x.of);
  request.answer_there = program.scale(*x.load, *x.scale, true);
  const DividedVector sum =
      program.combine_answers(pairs_there(0, num_pairs()), request.weights.head(num_pairs()));
  const DividedVector known = program.scale(sum, *x.scale, false);
  const std::array<std::pair<double, const DividedVector*>, 1> added = {{{1.0, &known}}};
  program.add(*x.load, added);
  program.run();
}

double RecycledSolves::norm_of_divided(const Request& request) const {
  RowProgram program(*request.of);
  return std::sqrt(run_for(program, program.square(request.remainder_there))[0]);
}

void RecycledSolves::separate_divided(int pair, Request& request) const {
  const RowProgram::Pairs one = pairs_there(pair, 1);
  RowProgram first(*request.of);
  const Vector along = run_for(first, first.pair_products(one, request.remainder_there));
  RowProgram second(*request.of);
  second.subtract_loads(one, request.remainder_there, along);
  second.add_answers(one, request.answer_there, -along);
  second.run();
}

void RecycledSolves::put_divided(int pair, double scale, const Request& request) const {
  RowProgram program(*request.of);
  program.put_pair(pairs_there(pair, 1), scale, request.remainder_there, request.answer_there);
  program.run();
}

}  // namespace buckens::linalg
