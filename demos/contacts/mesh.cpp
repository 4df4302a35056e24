// SPDX-License-Identifier: BSD-3-Clause
#include "contacts/mesh.h"

namespace contacts {

void Mesh::add_vertex(double x, double y, double z) {
  for (const double value : {x, y, z}) vertices.push_back(static_cast<float>(value));
}

void Mesh::add_quad(dTriIndex a, dTriIndex b, dTriIndex c, dTriIndex d) {
  indices.insert(indices.end(), {a, b, c, a, c, d});
}

Mesh make_box(double x, double y, double z) {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.add_vertex((corner & 1) != 0 ? x / 2 : -x / 2, (corner & 2) != 0 ? y / 2 : -y / 2,
                    (corner & 4) != 0 ? z / 2 : -z / 2);
  mesh.add_quad(0, 2, 3, 1);
  mesh.add_quad(4, 5, 7, 6);
  mesh.add_quad(0, 1, 5, 4);
  mesh.add_quad(2, 6, 7, 3);
  mesh.add_quad(0, 4, 6, 2);
  mesh.add_quad(1, 3, 7, 5);
  return mesh;
}

Mesh make_comb(int teeth, double width, double z) {
  // The outline in the plane of x and z, then both sides and what is between them.
  Mesh mesh;
  const auto columns = static_cast<dTriIndex>(2 * teeth);
  const double left = -(2 * teeth - 1) * width / 2;
  for (const double y : {-width / 2, width / 2}) {
    for (const double height : {-z, 0.0, width}) {
      for (dTriIndex i = 0; i < columns; ++i) mesh.add_vertex(left + i * width, y, height);
    }
  }
  const dTriIndex back = 3 * columns, low = 0, middle = columns, top = 2 * columns;
  // A wall over the outline from a to b, which runs counter-clockwise seen from the front.
  const auto wall = [&](dTriIndex a, dTriIndex b) { mesh.add_quad(b, a, a + back, b + back); };
  const auto front = [&](dTriIndex a, dTriIndex b, dTriIndex c, dTriIndex d) {
    mesh.add_quad(a, b, c, d);
    mesh.add_quad(d + back, c + back, b + back, a + back);
  };
  for (dTriIndex i = 0; i + 1 < columns; ++i) {
    front(middle + i, middle + i + 1, top + i + 1, top + i);
    wall(top + i + 1, top + i);
    if (i % 2 == 1) {
      wall(middle + i, middle + i + 1);
      continue;
    }
    front(low + i, low + i + 1, middle + i + 1, middle + i);
    wall(low + i, low + i + 1);
    wall(low + i + 1, middle + i + 1);
    wall(middle + i, low + i);
  }
  wall(middle + columns - 1, top + columns - 1);
  wall(top, middle);
  return mesh;
}

Mesh make_ridges(double side, int ridges, double height) {
  Mesh mesh;
  const int columns = 2 * ridges;
  for (int i = 0; i <= columns; ++i) {
    for (const double y : {-side / 2, side / 2})
      mesh.add_vertex(side * i / columns - side / 2, y, i % 2 == 1 ? height : 0);
  }
  for (dTriIndex i = 0; i < static_cast<dTriIndex>(columns); ++i)
    mesh.add_quad(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1);
  return mesh;
}

}  // namespace contacts
