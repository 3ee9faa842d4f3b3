// diptych: the words of gmsh's .geo language, sorted by what they may do
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/geo_words.h"

#include <set>
#include <sstream>

namespace diptych::continuum
{
  namespace
  {
    // gmsh's reference manual, "Gmsh scripting language"; its lexer (Gmsh.l) lists the same words.
    constexpr const char *shape_words = R"(
      Point Points Line Lines Curve Curves Circle Ellipse Ellipsis Elliptic Spline BSpline CatmullRom Bezier Nurbs Knots Order
      Catenary Compound Loop Wire Plane Surface Surfaces Ruled Filling Polar Sphere PolarSphere Parametric Euclidian Coordinates
      Volume Volumes Physical Group Rectangle Disk Box Block Cylinder Cone Wedge Torus Ellipsoid ThruSections Fillet Chamfer Sewing
      BooleanUnion BooleanFuse BooleanIntersection BooleanCommon BooleanDifference BooleanCut BooleanFragments BooleanCoherence
      BooleanSection HealShapes SetFactory Unique Degenerated
      Extrude Translate Rotate Symmetry Dilate Affine Duplicata Split Boundary CombinedBoundary PointsOf BoundingBox CenterOfMass
      Mass Parent Intersect Closest Coherence Delete Recursive Hide Show All Model Physicals Variables Embedded Hole Using Layers
      ScaleLastLayer QuadTriAddVerts QuadTriNoNewVerts RecombLaterals TransfQuadTri Periodic In SetTag SetMaxTag
      Transfinite Progression Bump Beta Left Right Alternate AlternateRight AlternateLeft Recombine Smoother Reverse ReverseMesh
      Characteristic Length MeshSize MeshAlgorithm MeshSizeFromBoundary Mesh Geometry RefineMesh RecombineMesh RelocateMesh
      RenumberMeshNodes RenumberMeshElements)";
    constexpr const char *size_words  = R"(
      Field Background BoundaryLayer Attractor AttractorAnisoCurve Ball Constant Curvature Distance Extend Frustum Gradient
      IntersectAniso Laplacian LonLat MathEval MathEvalAniso Max MaxEigenHessian Mean Min MinAniso Param Restrict Threshold)";
    constexpr const char *value_words = R"(
      If ElseIf Else EndIf For EndFor Printf Error Warning
      Abs Acos ArcCos Asin ArcSin Atan ArcTan Atan2 ArcTan2 Ceil Cos Cosh Exp Fabs Floor Fmod Hypot Log Log10 Modulo Rand Round Sin
      Sinh Sqrt Step Tan Tanh Pi GMSH_MAJOR_VERSION GMSH_MINOR_VERSION GMSH_PATCH_VERSION
      List LinSpace LogSpace Find Append Exists Str Sprintf StrCat StrChoice StrCmp StrFind StrLen StrPrefix StrRelative StrReplace
      StrSub UpperCase LowerCase LowerCaseIn
      DefineConstant DefineNumber DefineString UndefineConstant Name Label Help Units Kind Range Choices Visible ReadOnly Closed
      Highlight)";
    constexpr const char *never_words = R"(
      System SystemCall NonBlockingSystemCall ExternalProcess CommandLine OnelabRun OnelabAction Exit Abort Sleep
      Save Print PrintScreen Merge MergeFile MergeWithBoundingBox Include ShapeFromFile ListFromFile FileName FileExists CreateDir
      UnlinkFile DeleteFile CurrentDir CurrentDirectory CurrentFileName AbsolutePath DirName FixRelativePath GmshExecutableName
      CodeName Today TIME Cpu Memory TotalMemory MPI_Rank MPI_Size
      GetValue GetEnv GetString GetStringValue GetNumber GetForced GetForcedStr SetNumber SetString SetChanged SyncModel NewModel
      StringFromName NameFromString StringToName NameToString S2N N2S Parse Macro Function Call CallTest Return
      Struct NameStruct DimNameSpace ServerAction GmshOption AutoCheck Homology Cohomology Betti Levelset AdaptMesh OptimizeMesh
      ClassifySurfaces CreateTopology CreateGeometry TransformMesh SetPartition PartitionMesh SetName Remesh Status
      PostView Structured AutomaticMeshSizeField Octree Draw Plugin View Combine Alias AliasWithOptions CopyOptions
      General Solver PostProcessing)";

    std::set<std::string> set_of(const std::string &words)
    {
      std::istringstream    in(words);
      std::set<std::string> result;
      for (std::string word; in >> word;)
        result.insert(word);
      return result;
    }
  } // namespace

  bool makes_shapes(const std::string &word)
  {
    static const std::set<std::string> words = set_of(std::string(shape_words) + size_words + value_words);
    return words.count(word) > 0;
  }

  bool is_never_allowed(const std::string &word)
  {
    static const std::set<std::string> words = set_of(never_words);
    return words.count(word) > 0;
  }
} // namespace diptych::continuum
