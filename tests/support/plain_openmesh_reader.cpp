// SPDX-License-Identifier: BSD-3-Clause
// Usage: plain_openmesh_reader IN.om OUT.om
// A program of someone who has OpenMesh and nothing else: reads a mesh and writes what it got. Of
// the properties it knows the vertices' "mass" and the mesh's "note".
#include <string>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>

struct DoublePoints : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  OpenMesh::PolyMesh_ArrayKernelT<DoublePoints> mesh;
  if (!OpenMesh::IO::read_mesh(mesh, argv[1])) return 1;
  OpenMesh::VPropHandleT<double> mass;
  OpenMesh::MPropHandleT<std::string> note;
  if (!mesh.get_property_handle(mass, "mass") || !mesh.get_property_handle(note, "note")) return 1;
  mesh.property(mass).set_persistent(true);
  mesh.mproperty(note).set_persistent(true);
  return OpenMesh::IO::write_mesh(mesh, argv[2]) ? 0 : 1;
}
