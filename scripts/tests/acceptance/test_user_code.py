"""Tests that a user's C# compiles in projects whose other packages contain types with the same names as types of this package."""
import re
import tempfile
import unittest
from pathlib import Path

import pytest

from build import csharp
from build.places import BUILD, CSHARP, ROOT

OTHER_PACKAGES = """
namespace Google.FlatBuffers { public struct Table { } public struct ByteBuffer { } public interface IFlatbufferObject { } public class FlatBufferBuilder { } }
namespace Unity.Collections { public sealed class ReadOnlyAttribute : System.Attribute { } }
"""
USER = """
using Collektive.Unity;
using Google.FlatBuffers;
using Unity.Collections;
using UnityEngine;

namespace CollektiveSamples.GradientAscent
{
    public sealed class CopyOfASample : Sensor<gradientascent.SensorData>
    {
        [ReadOnly] public Unity.Collections.NativeArray<int> numbers;
        [InspectorReadOnly] public float shown;
        public Google.FlatBuffers.Table table;
        public ByteBuffer buffer;

        protected override void Sense(ref gradientascent.SensorData data) => data.Position = transform.position + Vector3.up;
    }
}
"""


class UserCode(unittest.TestCase):
    @pytest.mark.slow
    def test_names_of_other_packages_are_not_ambiguous(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for file, text in ("Other.cs", OTHER_PACKAGES), ("User.cs", USER):
                (folder / file).write_text(text)
            csharp.compile_assembly(folder / "Other.dll", [folder / "Other.cs"], [])
            package = [f"-r:{CSHARP}/{assembly}.dll" for assembly in ("Collektive.FlatBuffers", "Collektive.Bridge", "UnityEngine", "Collektive.Unity")]
            generated = csharp.sources([BUILD / "generated/samples/GradientAscent"])
            csharp.compile_assembly(folder / "User.dll", [folder / "User.cs", *generated], [*package, f"-r:{folder}/Other.dll"])

    def test_samples_are_outside_the_namespace_that_hides_unitys(self) -> None:
        places = [*ROOT.glob("unity/Samples~/*/*.cs"), *ROOT.glob("Documentation~/*.md")]
        self.assertEqual([path.name for path in places if re.search(r"(?m)^ *namespace Collektive\.", path.read_text())], [])
