// tf's vectors, quaternions, matrices and transforms.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#ifndef TFSIMD_PI
#define TFSIMD_PI 3.1415926535897932384626433832795029
#define TFSIMD_2_PI (2.0 * TFSIMD_PI)
#define TFSIMD_HALF_PI (TFSIMD_PI * 0.5)
#define TFSIMD_RADS_PER_DEG (TFSIMD_2_PI / 360.0)
#define TFSIMD_DEGS_PER_RAD (360.0 / TFSIMD_2_PI)
#define TFSIMDSQRT12 0.7071067811865475244008443621048490
#define TFSIMD_EPSILON 2.220446049250313e-16
#define TFSIMD_INFINITY 1.7976931348623157e+308
#define TFSIMD_FORCE_INLINE inline
#define tfRecipSqrt(x) (1.0 / tfSqrt(x))
#define tfAssert(x) static_cast<void>(0)
#define tfFullAssert(x) static_cast<void>(0)
#endif

#define GAZELLE_LINEAR_NAMESPACE tf
#define GAZELLE_LINEAR(name) tf##name
#include "gazelle/linear_math.inc"
#undef GAZELLE_LINEAR
#undef GAZELLE_LINEAR_NAMESPACE
