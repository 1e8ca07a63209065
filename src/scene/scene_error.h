#pragma once

#include <stdexcept>

namespace strata::scene {

// A scene, a scene file or a --set that cannot be used. what() is one line for the user:
// `file:line:column: key: what (value), allowed: ..., did you mean 'x'?`, without the parts that do not apply.
class SceneError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace strata::scene
