#include "tf/errors.h"

namespace stillframe::tf {

std::string_view toString(InsertError error) noexcept {
  switch (error) {
    case InsertError::EmptyFrameName:
      return "EmptyFrameName";
    case InsertError::SelfLoop:
      return "SelfLoop";
    case InsertError::NotFinite:
      return "NotFinite";
    case InsertError::ZeroQuaternion:
      return "ZeroQuaternion";
    case InsertError::ReparentConflict:
      return "ReparentConflict";
    case InsertError::Cycle:
      return "Cycle";
  }
  return "?";
}

std::string_view toString(LookupError error) noexcept {
  switch (error) {
    case LookupError::UnknownTarget:
      return "UnknownTarget";
    case LookupError::UnknownSource:
      return "UnknownSource";
    case LookupError::Disconnected:
      return "Disconnected";
    case LookupError::NoSampleAtTime:
      return "NoSampleAtTime";
  }
  return "?";
}

}  // namespace stillframe::tf
