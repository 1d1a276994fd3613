//! The corpus: designs from which inputs are mutated. Most are valid, and a few are refused as they
//! stand.

/// Small drafts, each with something that the others lack.
pub(crate) const WIF: &[&str] = &[
    "[WIF]\nVersion=1.1\n[WEAVING]\nShafts=4\nTreadles=4\nRising Shed=true\n[WARP]\nThreads=5\nUnits=Centimeters\n\
     Spacing=0.2\nThickness=0.1\nColor=1\n[WEFT]\nThreads=4\nUnits=Centimeters\nSpacing=0.3\nThickness=0.1\nColor=2\n\
     [COLOR PALETTE]\nEntries=2\nRange=0,255\n[COLOR TABLE]\n1=10,20,30\n2=40,50,60\n[THREADING]\n1=1\n2=2\n3=3\n4=4\n5=1\n\
     [TIEUP]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n[TREADLING]\n1=1\n2=2\n3=3\n4=4\n",
    "[WEAVING]\nShafts=2\nRising Shed=0\n[WARP]\nThreads=6\nUnits=Decipoints\nSpacing=60\nThickness=60\n[WEFT]\nThreads=6\n\
     Units=Inches\nSpacing=.083\nThickness=.083\n[WARP SPACING]\n2=30\n5=90\n[WEFT THICKNESS]\n1=.04\n3=\n[WARP COLORS]\n1=3\n\
     2=4,1,2,3\n[COLOR TABLE]\n3=999,0,500\n[THREADING]\n1=1\n2=2\n3=1,2\n4=0\n5=1\n6=2\n[LIFTPLAN]\n1=1\n2=2\n3=1,2\n4=0,1\n",
    "junk\n[TEXT]\nTitle=T\n[CONTENTS]\nTIEUP=true\n[THREADING]\n1=1\n2=2\n3=3\n[TIEUP]\n1=1\n2=2\n3=3\n6=1,2,3\n[TREADLING]\n\
     1=1,6\n2=2\n3=3\n[LIFTPLAN]\n1=1\n2=2\n3=3\n[WEAVING]\nTreadles=3\nShafts=3\n[WARP]\nThreads=3\nColor=1,255,0,0\n[WEFT]\n\
     Threads=3\n[PRIVATE X Y]\n1=2\n",
];

/// Drafts of Fiberworks: with a treadle for each pick, with several, and with a lift plan.
pub(crate) const DTX: &[&str] = &[
    "@@StartDTX\n%%version 1\n\n@@Description\nT\n\n@@Info\n%%shafts 4 \n%%treadles 6 \n%%ends 5   \n%%picks 4   \n\n\
     @@Threading\n1  2  3  4  1\n\n@@Tieup\n000101\n001010\n010001\n100010\n\n@@Treadling\n 6  5  4  3\n\n@@Color Palet\n\
     255,255,255\n255,0,0\n\n@@Warp Colors\n0  1  1\n\n@@Warp Spacing\n4  3  2  1\n\n@@EndDTX\n",
    "@@StartDTX\n@@Imprint\nPCW 4.2.0\n@@Info\n%%shafts 2\n%%treadles 2\n%%ends 6\n%%picks 3\n@@Threading\n1 2 0\n2 1\n@@Tieup\n\
     %%%%sinking\n01\n10\n11\n@@Treadling\n%%compound\n1,2  2  0,1\n@@Color Palette\n1,2,3\n4,5,6\n7,8,9\n@@Weft Colors\n2 0 1\n\
     @@Weft Spacing\n8 0 1\n@@EndDTX\n",
    "@@StartDTX\n@@Info\n%%shafts 3\n%%ends 3\n%%picks 4\n@@Threading\n3 2 1\n@@Liftplan\n101\n010\n110\n0011\n@@Notes\nn\n",
];

/// Design files whose weave is a notation.
pub(crate) const DESIGNS: &[&str] = &[
    "name = \"Denim\"\n[weave]\nnotation = \"3/1\"\nends = 7\npicks = 5\n[yarns.indigo]\ntex = 84.0\ncolor = \"#2b3f6b\"\n\
     twist_per_m = -500.0\n[yarns.ecru]\ndiameter_mm = 0.25\nplies = 2\nvalley = 0.75\n[warp]\nyarns = [\"2 indigo\", \"ecru\"]\nper_cm = 12.5\n\
     [weft]\nyarns = [\"ecru\"]\nspacing_mm = 1.25\n[finish]\nwarp_tension = 2\ncalender = 0.5\nstretch_weft = 1.01\n",
    "[weave]\nnotation = \"satin 8(3)\"\nends = 9\npicks = 8\n[cloth]\nshape = \"crossing\"\nwarp_crimp = 0.3\nselvedge = true\n\
     jam = \"flatten\"\n[yarns.a]\ndiameter_mm = 0.3\nsection = { shape = \"ellipse\", aspect = 1.4 }\n[yarns.b]\ndiameter_mm = 0.3\n\
     section = { shape = \"lenticular\", aspect = 2.0, distortion = 0.2 }\n[warp]\nyarns = [\"a\", \"3 b\"]\nspacing_mm = [0.9, 0.3]\n\
     [weft]\nyarns = [\"b\"]\nper_cm = 20\n",
    "[weave]\nnotation = \"herringbone 2/2(4)\"\nends = 8\npicks = 8\n[cloth]\nshape = \"round\"\njam = \"shrink\"\n[yarns.p]\n\
     diameter_mm = 0.4\nsection = { shape = \"polygon\", corners = [[1.0, -0.5], [1.0, 0.5], [-1.0, 0.5], [-1.0, -0.5]] }\n\
     [yarns.q]\ntex = 20\nsection = { shape = \"power-ellipse\", aspect = 2.0, exponent = 0.6 }\n[warp]\nyarns = [\"p\"]\n\
     spacing_mm = 0.5\n[weft]\nyarns = [\"p\"]\nspacing_mm = 0.5\n",
];

/// Design files with an image `motif.png` or a draft `draft.wif` beside them.
pub(crate) const PAPERS: &[&str] = &[
    "[weave]\nimage = \"motif.png\"\n[yarns.a]\ndiameter_mm = 0.2\n[warp]\nyarns = [\"a\"]\nspacing_mm = 0.6\n[weft]\nyarns = [\"a\"]\n\
     spacing_mm = 0.6\n",
    "[weave]\nimage = \"motif.png\"\nrows = \"first-pick-first\"\nrepeat = [2, 1]\n[weave.colors]\n\"#000000\" = \"3/1\"\n\
     \"#ffffff\" = \"sateen 5(2)\"\n\"#c81020\" = \"plain\"\n[yarns.a]\ndiameter_mm = 0.2\n[yarns.b]\ntex = 30\ncolor = \"#010203\"\n\
     [warp]\nyarns = [\"2 a\", \"b\"]\nspacing_mm = 0.6\n[weft]\nyarns = [\"b\"]\nper_cm = 15\n",
    "[weave]\nwif = \"draft.wif\"\n[cloth]\njam = \"shrink\"\nselvedge = true\n[yarns.a]\ndiameter_mm = 0.1\ncolor = \"#010203\"\n\
     [weft]\nyarns = [\"a\"]\nper_cm = 20.0\n",
];

/// Small programs of knitting machines, each with something that the others lack.
pub(crate) const KNITOUT: &[&str] = &[
    ";!knitout-2\n;;Machine: SWG091N2\n;;Gauge: 15\n;;Yarn-5: 50-50 Rust\n;;Carriers: 1 2 5\n;;Position: Right\ninhook 5\n\
     tuck - f3 5\ntuck - f1 5\ntuck + f2 5\nreleasehook 5\nknit - f3 5\nknit - f2 5\nknit - f1 5\nxfer f2 b2\nrack 1\n\
     xfer b2 f3\nrack 0\nknit + f1 5\nknit + f2 5\nknit + f3 5\nouthook 5\n",
    ";;Carriers: A B\nin A\nin B\nx-stitch-number 70\nstitch 10 -2.5\nrack 0.25\nknit + f1 A B\nknit + b1 A B\nknit + f2 A\n\
     miss + f3 A\nsplit - f2 b2 B\ntuck - f1 B\nrack -0.75\nknit + b-1 A\ndrop b1\namiss f1\npause\nout A B\n",
    ";!knitout-3\nin yarn ;comment\nknit + f0 yarn\nknit + fs1 yarn\nxfer f0 bs0\nxfer bs0 f0\nknit - f0 yarn\nknit - f0\n",
];

/// OBJ files with polylines: of several vertices and of an edge at a time, open and closed, beside
/// statements that are passed over.
pub(crate) const POLYLINES: &[&str] = &[
    "# two yarns\nv 0 0 0\nv 1 0.5 0.2\nv 2 0 -0.1\nv 3.5 0 0 1.0\nl 1 2 3 4\nv 0 1 0\nv 3 1 0\nl -2 -1\n",
    "mtllib cloth.mtl\no ring\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\ns off\n\
     l 1 2\nl 2 3\nl 3 4\nl 4 1\n",
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nl 1/1 2/1 \\\n 3/1 1/1\n",
];

/// USD files with curves of every basis and of every wrap.
pub(crate) const STAGES: &[&str] = &[
    "#usda 1.0\n(\n    metersPerUnit = 0.001\n    upAxis = \"Z\"\n)\ndef Xform \"cloth\" (\n    kind = \"component\"\n)\n{\n\
     def BasisCurves \"a\" (\n    displayName = \"red \\\"\"\n)\n{\n    uniform token basis = \"catmullRom\"\n    int[] \
     curveVertexCounts = [4, 6]\n    point3f[] points = [(-1, 0, 0), (0, 0, 0.5), (1, 0.5, 0), (2, 0, 0), (0, 1, 0), (0, 0, 0), \
     (1, 0, 0), (0, 1, 0), (0, 0, 0), (1, 0, 0)]\n    int[] primvars:yarn = [1, 0] (\n interpolation = \"uniform\"\n)\n    float[] \
     widths = [0.2, 0.3, 0.1, 0.1, 0.2, 0.1] (\n interpolation = \"varying\"\n )\n    color3f[] primvars:displayColor = [(1, 0, \
     0.2)]\n    uniform token type = \"cubic\"\n    uniform token wrap = \"nonperiodic\"\n}\n}\n",
    "#usda 1.0\ndef Xform \"x\"\n{\n    matrix4d xformOp:transform = ( (0, 0.1, 0, 0), (0, 0, 0.1, 0), (0.1, 0, 0, 0), (5, 6, 7, 1) \
     )\n    uniform token[] xformOpOrder = [\"!resetXformStack!\", \"xformOp:transform\"]\n    def BasisCurves \"b\"\n    {\n        \
     float3 xformOp:rotateXYZ = (10, 20, 30)\n        double3 xformOp:translate:pivot = (1, 2, 3)\n        float3 xformOp:scale = (1, 1, \
     -1)\n        quatf xformOp:orient = (1, 0.5, 0, 0)\n        uniform token[] xformOpOrder = [\"xformOp:translate:pivot\", \
     \"xformOp:rotateXYZ\", \"xformOp:scale\", \"xformOp:orient\", \"!invert!xformOp:translate:pivot\"]\n        int[] \
     curveVertexCounts = [4]\n        point3f[] points = [(0, 0, 0), (1, 2, 0), (2, -2, 1), (3, 0, 0)]\n        float[] widths = \
     [0.1]\n    }\n}\n",
    "#usda 1.0\n(\n    \"two kinds\"\n    customLayerData = {\n        dictionary a = { string b = 'c' }\n    }\n    upAxis = \"X\"\n)\n\
     class \"gone\" { }\ndef BasisCurves \"s\" (active = true) { uniform token basis = \"bspline\"; uniform token wrap = \
     \"periodic\"\nint[] curveVertexCounts = [5]\npoint3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (-1, 0.5, 1)]\n\
     float[] widths = [1, 1, 2, 1, 1] }\n# lines\ndef BasisCurves \"l\" { uniform token type = \"linear\"\nint[] curveVertexCounts = \
     [2, 3]\npoint3f[] points = [(0, 0, 0), (1, 0, 0), (5, 5, 5), (6, 5, 5), (6, 6.5, 5)]\nfloat[] widths = [0.1, 0.2] (interpolation = \
     \"uniform\")\ncolor3f[] primvars:displayColor = [(0, 0, 0), (1, 1, 1)] (interpolation = \"uniform\")\ntoken[] a.timeSamples = { 1: \
     [\"x\"], }\nrel m = </gone> }\n",
    "#usda 1.0\ndef BasisCurves \"p\" { uniform token basis = \"catmullRom\"\nuniform token wrap = \"pinned\"\nint[] \
     curveVertexCounts = [4]\npoint3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]\nfloat[] widths = [0.1, 0.2, 0.2, \
     0.1] }\n",
];

/// TexGen files with every kind of path and section that is read.
pub(crate) const TEXGEN: &[&str] = &[
    "<?xml version=\"1.0\" ?>\n<TexGenModel version=\"3.14.0\">\n<Textile GeometryScale=\"mm\" type=\"CTextile\">\n<Domain \
     type=\"CDomainPlanes\"><Plane Normal=\"1, 0, 0\" d=\"0\" /></Domain>\n<Yarn index=\"0\">\n<Interpolation Periodic=\"1\" \
     type=\"CInterpolationCubic\" />\n<YarnSection type=\"CYarnSectionConstant\">\n<Section type=\"CSectionEllipse\" Width=\"0.4\" \
     Height=\"0.2\" />\n</YarnSection>\n<Repeat value=\"4, 0, 0\" />\n<MasterNode Position=\"0, 0, 0\" Up=\"0, 0, 1\" \
     Angle=\"0\" />\n<MasterNode Position=\"1, 0, 0.2\" Up=\"0, 1, 1\" />\n<MasterNode Position=\"2.5, 0.1, -0.1\" />\n<MasterNode \
     Position=\"4, 0, 0\" />\n</Yarn>\n<Yarn index=\"1\">\n<Interpolation Periodic=\"0\" ForceMasterNodeTangent=\"1\" \
     type=\"CInterpolationBezier\" />\n<YarnSection type=\"CYarnSectionInterpNode\">\n<NodeSection>\n<Section type=\"CSectionLenticular\" \
     Width=\"0.4\" Height=\"0.2\" Distortion=\"0.02\" />\n<MidNodeSection t=\"0.5\"><Section type=\"CSectionPowerEllipse\" Width=\"0.3\" \
     Height=\"0.2\" Power=\"0.6\" XOffset=\"0\" /></MidNodeSection>\n</NodeSection>\n<NodeSection>\n<Section \
     type=\"CSectionRectangle\" Width=\"0.4\" Height=\"0.2\" />\n</NodeSection>\n</YarnSection>\n<MasterNode Position=\"0, 1, 0\" \
     Tangent=\"0, 1, 0\" />\n<MasterNode Position=\"1, 2, 0\" />\n</Yarn>\n</Textile>\n</TexGenModel>\n",
    "<TexGenModel>\n<Textile GeometryScale=\"cm\">\n<Yarn>\n<Interpolation Periodic=\"1\" type=\"CInterpolationLinear\" />\n<YarnSection \
     type=\"CYarnSectionConstant\">\n<Section type=\"CSectionPolygon\">\n<PolygonPoint value=\"0.03, 0\" />\n<PolygonPoint \
     value=\"-0.02, 0.01\" />\n<PolygonPoint value=\"-0.02, -0.01\" />\n</Section>\n</YarnSection>\n<MasterNode Position=\"0, 0, 0\" \
     />\n<MasterNode Position=\"1, 0, 0\" />\n<MasterNode Position=\"1, 1, 0\" />\n<MasterNode Position=\"0, 1, 0\" />\n<MasterNode \
     Position=\"0, 0, 0\" />\n</Yarn>\n</Textile>\n</TexGenModel>\n",
];

/// Design files of knits, some with an image `motif.png` or a program `program.k` beside them.
pub(crate) const KNITS: &[&str] = &[
    "[knit]\nchart = \"\"\"\nkkRRrrk\n>kpptk<\nkkmkllL\n\"\"\"\nrepeat = [2, 1]\nyarns = [\"2 a\", \"b\"]\nwales_per_cm = 8\ncourses_per_cm = 10\n\
     [yarns.a]\ndiameter_mm = 0.2\n[yarns.b]\ntex = 20\n",
    "[knit]\nchart = \"\"\"\nbu\nkp\nbb\n\"\"\"\nbeds = 2\nloop_length_mm = 5.0\ncompression = 0.9\ncells = \"even\"\nfloat_max = 3\n[yarns.a]\n\
     diameter_mm = 0.2\nplies = 2\ntwist_per_m = 100\n",
    "[knit]\nimage = \"motif.png\"\nbacking = \"birdseye\"\nneedles_per_inch = 10\ncourses_per_cm = 20\n[knit.colors]\n\"#000000\" = \"a\"\n\
     \"#ffffff\" = \"b\"\n\"#c81020\" = \"a\"\n[yarns.a]\ndiameter_mm = 0.2\n[yarns.b]\ntex = 20\n",
    "[knit]\nknitout = \"program.k\"\nyarns = [\"a\"]\nwales_per_cm = 8\ncourses_per_cm = 10\n[knit.stitch_lengths_mm]\n70 = 5.5\n\
     [yarns.a]\ndiameter_mm = 0.2\n",
    "[knit]\nchart = \"\"\"\nr w w\nwrr\n\"\"\"\nbacking = \"ladder\"\nwales_per_cm = 8\ncourses_per_cm = 10\n[knit.colors]\nr = \"a\"\n\
     w = \"b\"\n[yarns.a]\ntex = 30\n[yarns.b]\ntex = 30\n",
    "[knit]\nimage = \"motif.png\"\nrows = \"first-pick-first\"\nyarns = [\"a\"]\nrepeat = [1, 3]\nwales_per_cm = 4\ncourses_per_cm = 20\n\
     [knit.colors]\n\"#000000\" = \"p\"\n\"#ffffff\" = \"k\"\n\"#c81020\" = \"m\"\n[finish]\nlength = 1.05\npress = 0.6\n[yarns.a]\ntex = 30\n",
    "[knit]\nchart = \"\"\"\nm m b\nu p b\nkpp\n\"\"\"\nbeds = 2\nyarns = [\"1 a\", \"1 a\"]\nrepeat = [3, 1]\nwales_per_cm = 5\n\
     courses_per_cm = 9\n[finish]\nlength = \"free\"\ntension = 0.01\n[yarns.a]\ndiameter_mm = 0.2\n",
];

/// Design files of warp knits, some with an image `motif.png` beside them.
pub(crate) const WARPS: &[&str] = &[
    "[warp_knit]\nwales = 8\ncourses = 8\nwales_per_cm = 10\ncourses_per_cm = 13\n[[warp_knit.bars]]\nlapping = \"1-0/1-2//\"\n\
     threading = [\"a\"]\nrun_in_mm = 1600\n[[warp_knit.bars]]\nlapping = \"closed atlas 3\"\nthreading = [\"2 b\", \"out\", \"b\"]\n\
     offset = -2\n[finish]\nlength = 1.1\n[yarns.a]\ndiameter_mm = 0.1\n[yarns.b]\ntex = 8\n",
    "[warp_knit]\nwales = 4\ncourses = 6\nrepeat = [2, 2]\nneedles_per_inch = 24\ndraw_in = 0.8\ncourses_per_cm = 18\ncells = \"even\"\n\
     compression = 0.9\n[[warp_knit.bars]]\nlapping = \"2-0/(4-3/2-3)x2/2-4//\"\n[[warp_knit.bars]]\nlapping = \"inlay 3\"\n\
     [finish]\nsettle = false\n[yarns.a]\ndiameter_mm = 0.1\n",
    "[warp_knit]\nwales = 24\ncourses = 24\nwales_per_cm = 10\ncourses_per_cm = 13\n[[warp_knit.bars]]\nlapping = \"1-0/1-2//\"\n\
     image = \"motif.png\"\n[warp_knit.bars.colors]\n\"#000000\" = \"0-0/0-0\"\n\"#ffffff\" = \"0-0/1-1\"\n\"#c81020\" = \"1-1/0-0\"\n\
     [[warp_knit.bars]]\nlapping = \"8-10/2-4//\"\nstep = 2\nimage = \"motif.png\"\nrows = \"first-pick-first\"\n[warp_knit.bars.colors]\n\
     \"#000000\" = \"1-1/0-1\"\n\"#ffffff\" = \"0-1/1-0\"\n\"#c81020\" = \"1-0/0-0\"\n[yarns.a]\ndiameter_mm = 0.1\n",
];

/// Notations of weaves. Each is written in a different way.
pub(crate) const NOTATIONS: &[&str] = &[
    "plain",
    "3/1",
    "2/2(1)",
    "1/3(-1)",
    "3/1*1/2(2)",
    "2/2(2+2)",
    "satin 8(3)",
    "sateen 5",
    "matt 2",
    "hopsack 3/2",
    "herringbone 2/2(16)",
    "pointed 3/1(4)",
    "honeycomb",
    "crepe",
    "twill 2/1",
];

/// A design that is valid except for its weave `notation`, which may be anything.
pub(crate) fn design_of(notation: &str) -> String {
    let quoted: String = notation
        .chars()
        .map(|letter| match letter {
            '"' | '\\' => format!("\\{letter}"),
            _ if letter.is_control() => format!("\\u{:04x}", u32::from(letter)),
            _ => letter.into(),
        })
        .collect();
    format!(
        "[weave]\nnotation = \"{quoted}\"\nends = 9\npicks = 7\n[yarns.a]\ndiameter_mm = 0.2\n[warp]\nyarns = [\"a\"]\n\
         spacing_mm = 0.6\n[weft]\nyarns = [\"a\"]\nspacing_mm = 0.6\n"
    )
}
