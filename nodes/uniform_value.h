#pragma once

#include <osg/Uniform>

namespace stillframe::nodes {

/// Sets a uniform to what it is not yet: OSG hands one that was set to the driver again, the same value too.
template <typename Value>
void setIfNew(osg::Uniform& uniform, const Value& value) {
  Value there{};
  if (!uniform.get(there) || there != value) {
    uniform.set(value);
  }
}

}  // namespace stillframe::nodes
