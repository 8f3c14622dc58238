// SPDX-License-Identifier: Apache-2.0
#pragma once

// 1 if the code is built with the address or thread sanitizer, which have an allocator and an
// address space of their own; 0 otherwise. GCC and Clang say so in different ways.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define BUCKENS_IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define BUCKENS_IS_SANITIZED 1
#endif
#endif
#ifndef BUCKENS_IS_SANITIZED
#define BUCKENS_IS_SANITIZED 0
#endif
