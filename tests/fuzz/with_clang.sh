#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# with_clang.sh CLANG [CCACHE] -- COMPILER ARGUMENTS...: runs CLANG with the arguments that CMake wrote
# for another compiler. Thus clang, which has libFuzzer, builds the fuzz programs, and checks
# headers, in a build by g++.
command=
while [ "$1" != -- ]; do
  command="$1${command:+ $command}"
  shift
done
shift 2
# shellcheck disable=SC2086  # ccache and clang are two words
exec $command "$@"
