#pragma once

#include <CGAL/AABB_tree.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "libraries.h"
