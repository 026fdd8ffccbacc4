// SPDX-License-Identifier: BSD-3-Clause
// cageDeformMesh: moves the mesh of a case to a pose of a cage, once.
#include "Time.H"
#include "argList.H"
#include "polyMesh.H"

#include "cage_deformer.h"

int main(int argc, char* argv[]) {
  using namespace Foam;
  argList::addNote("Move the points of a mesh with a cage.");
  argList::noFunctionObjects();
  for (const char* const entry : {"binding", "pose"}) {
    argList::addOption(entry, "file");
  }
  argList::addOption("fixedPatches", "(patch ...)", "patches that do not move");
  argList::addOption("joint", "smooth | curvature", "smooth end where the cage cuts the mesh");
  argList::addOption("jointMass", "number", "weight from which on nothing changes, default 0.5");
  argList::addBoolOption("overwrite", "replace the points instead of writing the next time");

  const argList args(argc, argv);
  if (!args.checkRootCase()) FatalError.exit();
  Time time(Time::controlDictName, args);
  polyMesh mesh(IOobject(polyMesh::defaultRegion, time.timeName(), time, IOobject::MUST_READ));

  dictionary dict("arguments");
  dict.add("binding", args.get<fileName>("binding"));
  if (args.found("fixedPatches")) {
    dict.add("fixedPatches", args.getList<wordRe>("fixedPatches"));
  }
  if (args.found("joint")) dict.add("joint", args.get<word>("joint"));
  if (args.found("jointMass")) dict.add("jointMass", args.get<scalar>("jointMass"));
  const word instance = mesh.pointsInstance();
  const pointField rest = mesh.points();
  const flbc::foam::CageDeformer deformer(mesh, rest, dict, {{0, args.get<fileName>("pose")}});
  const auto points = deformer.positions(0);
  if (!args.found("overwrite")) ++time;
  mesh.movePoints(points());
  if (args.found("overwrite")) mesh.setInstance(instance);
  mesh.write();
  Info << "End" << endl;
  return 0;
}
