/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file export.h
 * ODE_EXT_API marks what the library exports; all else in it is hidden. ODE_EXT_STATIC is defined
 * by the CMake target and the pkg-config file of a static build, where nothing is exported.
 */
#ifndef ODE_EXT_EXPORT_H
#define ODE_EXT_EXPORT_H

#if !defined(ODE_EXT_STATIC) && (defined(__GNUC__) || defined(__clang__))
#define ODE_EXT_API __attribute__((visibility("default")))
#else
#define ODE_EXT_API
#endif

#endif
