// Why a transform cannot be had.
#pragma once

#include <stdexcept>
#include <string>

namespace tf2 {

// The numbers of tf2_msgs/TF2Error.
enum class TF2Error : unsigned char {
  TF2_NO_ERROR = 0,
  TF2_LOOKUP_ERROR = 1,
  TF2_CONNECTIVITY_ERROR = 2,
  TF2_EXTRAPOLATION_ERROR = 3,
  TF2_INVALID_ARGUMENT_ERROR = 4,
  TF2_TIMEOUT_ERROR = 5,
  TF2_TRANSFORM_ERROR = 6,
  TF2_BACKWARD_EXTRAPOLATION_ERROR = 7,
  TF2_FORWARD_EXTRAPOLATION_ERROR = 8,
  TF2_NO_DATA_FOR_EXTRAPOLATION_ERROR = 9,
  NO_ERROR = TF2_NO_ERROR,
  LOOKUP_ERROR = TF2_LOOKUP_ERROR,
  CONNECTIVITY_ERROR = TF2_CONNECTIVITY_ERROR,
  EXTRAPOLATION_ERROR = TF2_EXTRAPOLATION_ERROR,
  INVALID_ARGUMENT_ERROR = TF2_INVALID_ARGUMENT_ERROR,
  TIMEOUT_ERROR = TF2_TIMEOUT_ERROR,
  TRANSFORM_ERROR = TF2_TRANSFORM_ERROR,
};

// Visible from every library, so that what one throws another can catch.
#define GAZELLE_TF2_EXCEPTION(name, base)                                \
  class __attribute__((visibility("default"))) name : public base {      \
   public:                                                               \
    explicit name(const std::string& description) : base(description) {} \
  }

GAZELLE_TF2_EXCEPTION(TransformException, std::runtime_error);
GAZELLE_TF2_EXCEPTION(ConnectivityException, TransformException);
GAZELLE_TF2_EXCEPTION(LookupException, TransformException);
GAZELLE_TF2_EXCEPTION(ExtrapolationException, TransformException);
GAZELLE_TF2_EXCEPTION(InvalidArgumentException, TransformException);
GAZELLE_TF2_EXCEPTION(TimeoutException, TransformException);
GAZELLE_TF2_EXCEPTION(BackwardExtrapolationException, ExtrapolationException);
GAZELLE_TF2_EXCEPTION(ForwardExtrapolationException, ExtrapolationException);
GAZELLE_TF2_EXCEPTION(NoDataForExtrapolationException, ExtrapolationException);

#undef GAZELLE_TF2_EXCEPTION

}  // namespace tf2
