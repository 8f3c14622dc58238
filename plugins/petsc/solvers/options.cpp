// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <cctype>
#include <sstream>
#include <string>

#include "solver.h"

namespace buckens_petsc {

namespace {

/// Whether a text of options contains a name, with the dash.
bool has_option(const std::string& text, const std::string& name) {
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word == name) return true;
  }
  return false;
}

/// -5 is a value.
bool is_name(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
}

}  // namespace

PetscErrorCode set_options(const char* of_user, PetscOptions options) {
  PetscFunctionBeginUser;
  const char* const values[][2] = {
      {"-pc_gamg_type", "agg"},
      {"-pc_gamg_agg_nsmooths", "1"},
      {"-pc_gamg_threshold", "0.0"},
      {"-pc_gamg_coarse_eq_limit", "1000"},
      {"-mg_levels_ksp_type", "chebyshev"},
      {"-mg_levels_ksp_max_it", "2"},
      {"-mg_levels_pc_type", "jacobi"},
      {"-mg_levels_esteig_ksp_type", "cg"},
      {"-mg_levels_esteig_ksp_max_it", "10"},
  };
  for (const auto& option : values) PetscCall(PetscOptionsSetValue(options, option[0], option[1]));
  if (of_user != nullptr) PetscCall(PetscOptionsInsertString(options, of_user));
  PetscFunctionReturn(0);
}

PetscErrorCode refuse_words(const char* of_user) {
  PetscFunctionBeginUser;
  std::istringstream words(of_user == nullptr ? "" : of_user);
  bool may_be_value = false;
  for (std::string word; words >> word; may_be_value = is_name(word)) {
    if (is_name(word) || may_be_value) continue;
    set_error("\"" + word +
              "\" is neither an option of PETSc, as -pc_type is, nor the value of one");
    PetscFunctionReturn(PETSC_ERR_USER_INPUT);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode refuse_ends(PetscOptions options) {
  PetscFunctionBeginUser;
  for (const char* name : {"-ksp_rtol", "-ksp_atol", "-ksp_divtol", "-ksp_max_it", "-ksp_min_it",
                           "-ksp_convergence_test", "-ksp_converged_use_initial_residual_norm",
                           "-ksp_converged_use_min_initial_residual_norm", "-ksp_converged_maxits",
                           "-ksp_initial_guess_nonzero"}) {
    PetscBool is_given = PETSC_FALSE;
    PetscCall(PetscOptionsHasName(options, nullptr, name, &is_given));
    if (is_given == PETSC_FALSE) continue;
    set_error(std::string(name) +
              " would have no effect: Buckens begins each iteration with an extrapolated motion "
              "and ends it when its error is far below that of the step");
    PetscFunctionReturn(PETSC_ERR_USER_INPUT);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode refuse_unknown(const char* of_user, PetscOptions options) {
  PetscInt count = 0;
  char** names = nullptr;
  char** values = nullptr;
  std::string unknown;
  PetscFunctionBeginUser;
  if (of_user == nullptr) PetscFunctionReturn(0);
  PetscCall(PetscOptionsLeftGet(options, &count, &names, &values));
  for (PetscInt k = 0; k < count; ++k) {
    const std::string name = std::string("-") + names[k];
    if (has_option(of_user, name)) unknown += (unknown.empty() ? "" : ", ") + name;
  }
  PetscCall(PetscOptionsLeftRestore(options, &count, &names, &values));
  if (unknown.empty()) PetscFunctionReturn(0);
  set_error("PETSc has no use for the option " + unknown);
  PetscFunctionReturn(PETSC_ERR_USER_INPUT);
}

}  // namespace buckens_petsc
