// tf2's vectors, quaternions, matrices and transforms.
#pragma once

#include <algorithm>
// For programs that say isnan(…) without std::, which have it from here.
#include <math.h>

#include <cmath>
#include <limits>
#include <ostream>

#ifndef TF2SIMD_PI
#define TF2SIMD_PI 3.1415926535897932384626433832795029
#define TF2SIMD_2_PI (2.0 * TF2SIMD_PI)
#define TF2SIMD_HALF_PI (TF2SIMD_PI * 0.5)
#define TF2SIMD_RADS_PER_DEG (TF2SIMD_2_PI / 360.0)
#define TF2SIMD_DEGS_PER_RAD (360.0 / TF2SIMD_2_PI)
#define TF2SIMDSQRT12 0.7071067811865475244008443621048490
#define TF2SIMD_EPSILON 2.220446049250313e-16
#define TF2SIMD_INFINITY 1.7976931348623157e+308
#define TF2_LARGE_FLOAT 1e30
#define TF2SIMD_FORCE_INLINE inline
#define tf2RecipSqrt(x) (1.0 / tf2Sqrt(x))
#define tf2Assert(x) static_cast<void>(0)
#define tf2FullAssert(x) static_cast<void>(0)
#endif

#define GAZELLE_LINEAR_NAMESPACE tf2
#define GAZELLE_LINEAR(name) tf2##name
#include "gazelle/linear_math.inc"
#undef GAZELLE_LINEAR
#undef GAZELLE_LINEAR_NAMESPACE
