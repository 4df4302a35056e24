// SPDX-License-Identifier: BSD-3-Clause
// Which sanitizer a test is built with: GCC says it by a macro, clang by a feature.
#pragma once

#ifdef __has_feature
#define ODE_EXT_ADDRESS_SANITIZER __has_feature(address_sanitizer)
#define ODE_EXT_THREAD_SANITIZER __has_feature(thread_sanitizer)
#else
#ifdef __SANITIZE_ADDRESS__
#define ODE_EXT_ADDRESS_SANITIZER 1
#else
#define ODE_EXT_ADDRESS_SANITIZER 0
#endif
#ifdef __SANITIZE_THREAD__
#define ODE_EXT_THREAD_SANITIZER 1
#else
#define ODE_EXT_THREAD_SANITIZER 0
#endif
#endif
