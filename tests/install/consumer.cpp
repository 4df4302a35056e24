// SPDX-License-Identifier: BSD-3-Clause
// The public header compiles as C++ and the library links: exits 0 if a collider can be created.
#include <ode_ext/ode_ext.h>

#include <iostream>
#include <memory>
#include <type_traits>

int main() {
  dInitODE2(0);
  int status = 1;
  {
    using Destroy = decltype(&dBatchColliderDestroy);
    const std::unique_ptr<std::remove_pointer_t<dBatchColliderID>, Destroy> collider(
        dBatchColliderCreate(nullptr), &dBatchColliderDestroy);
    if (collider) {
      std::cout << "C++, version " << ODE_EXT_VERSION << '\n';
      status = 0;
    } else {
      std::cerr << dBatchColliderGetLastErrorMessage() << '\n';
    }
  }
  dCloseODE();
  return status;
}
