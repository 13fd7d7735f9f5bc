#!/usr/bin/env python3
"""Makes the package's materials, prefabs and sample scenes: `unity_assets.py ROOT [OUT]` writes them below ROOT, or below OUT.

They are what Unity 6000.0 writes, without the fields that have their default. File ids come from names, so that they last.
"""
import hashlib
import json
import math
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import metas
from validator.assets import guid_of

HEADER = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n"
PREFAB = 100100000
BUILT_IN_MESHES = "0000000000000000e000000000000000"
SPHERE = 10207
JAR = "Packages/org.collektive.unity/Jvm~/collektive-samples.jar"

# Where a sample scene's camera stands, and by how many degrees it looks down.
CAMERA = ((0, 55, -45), 52)
CAMERAS = {"Crowd": ((0, 40, -28), 56), "Swarm": ((0, 110, -190), 12)}


class Maker:
    """Writes files that refer to each other and to scripts by GUID."""

    def __init__(self, root, out):
        self.root = root
        self.out = out

    def guid(self, path):
        """The GUID that an asset has, or will get with its meta."""
        return guid_of(os.path.join(self.root, path + ".meta")) or metas.guid_for(path)

    def script(self, path):
        return f"{{fileID: 11500000, guid: {self.guid(path)}, type: 3}}"

    def write(self, path, documents):
        target = os.path.join(self.out, path)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open(target, "w") as file:
            file.write(HEADER + "".join(documents))


def file_id(path, name):
    """A positive 63-bit number."""
    return int(hashlib.md5(f"{path}/{name}".encode()).hexdigest()[:16], 16) >> 1


def vector(values):
    return "{" + ", ".join(f"{name}: {value:g}" for name, value in zip("xyzw", values)) + "}"


def colour(values):
    return "{" + ", ".join(f"{name}: {value:g}" for name, value in zip("rgba", values)) + "}"


def document(class_id, number, type_name, body):
    return f"--- !u!{class_id} &{number}\n{type_name}:\n" + body


OF_OBJECT = """  m_ObjectHideFlags: 0
  m_CorrespondingSourceObject: {fileID: 0}
  m_PrefabInstance: {fileID: 0}
  m_PrefabAsset: {fileID: 0}
"""


class GameObject:
    """A root object of a file, with its components."""

    def __init__(self, path, name, tag="Untagged", position=(0, 0, 0), rotation=(0, 0, 0, 1), scale=(1, 1, 1)):
        self.path = path
        self.name = name
        self.tag = tag
        self.components = []
        self.transform = self.add(4, "Transform", f"""  serializedVersion: 2
  m_LocalRotation: {vector(rotation)}
  m_LocalPosition: {vector(position)}
  m_LocalScale: {vector(scale)}
  m_ConstrainProportionsScale: 0
  m_Children: []
  m_Father: {{fileID: 0}}
  m_LocalEulerAnglesHint: {{x: 0, y: 0, z: 0}}
""")

    @property
    def number(self):
        return file_id(self.path, self.name)

    def add(self, class_id, type_name, body, name=None):
        """Adds a component and returns its file id."""
        number = file_id(self.path, f"{self.name}/{name or type_name}")
        self.components.append((class_id, number, type_name, OF_OBJECT + f"  m_GameObject: {{fileID: {self.number}}}\n" + body))
        return number

    def add_script(self, maker, script, fields=""):
        return self.add(114, "MonoBehaviour", f"""  m_Enabled: 1
  m_EditorHideFlags: 0
  m_Script: {maker.script(script)}
  m_Name: 
  m_EditorClassIdentifier: 
""" + fields, name=os.path.basename(script))

    def documents(self):
        listed = "".join(f"  - component: {{fileID: {number}}}\n" for _, number, _, _ in self.components)
        yield document(1, self.number, "GameObject", OF_OBJECT + f"""  serializedVersion: 6
  m_Component:
{listed}  m_Layer: 0
  m_Name: {self.name}
  m_TagString: {self.tag}
  m_Icon: {{fileID: 0}}
  m_NavMeshLayer: 0
  m_StaticEditorFlags: 0
  m_IsActive: 1
""")
        for component in self.components:
            yield document(*component)


def make_material(maker, name, shader, rgba):
    maker.write(f"unity/Materials/{name}.mat", [document(21, 2100000, "Material", f"""  serializedVersion: 8
{OF_OBJECT}  m_Name: {name}
  m_Shader: {{fileID: 4800000, guid: {maker.guid(f'unity/Materials/{shader}.shader')}, type: 3}}
  m_Parent: {{fileID: 0}}
  m_ModifiedSerializedProperties: 0
  m_ValidKeywords: []
  m_InvalidKeywords: []
  m_LightmapFlags: 4
  m_EnableInstancingVariants: 1
  m_DoubleSidedGI: 0
  m_CustomRenderQueue: -1
  stringTagMap: {{}}
  disabledShaderPasses: []
  m_LockedProperties: 
  m_SavedProperties:
    serializedVersion: 3
    m_TexEnvs: []
    m_Ints: []
    m_Floats: []
    m_Colors:
    - _Color: {colour(rgba)}
  m_BuildTextureStacks: []
  m_AllowLocking: 1
""")])


MANAGER = "unity/Prefabs/Simulation Manager.prefab"
MANAGER_SCRIPT = "unity/Runtime/Unity/Manager/SimulationManager.cs"


def make_manager(maker):
    manager = GameObject(MANAGER, "Simulation Manager")
    manager.add_script(maker, MANAGER_SCRIPT)
    material = f"  material: {{fileID: 2100000, guid: {maker.guid('unity/Materials/Link.mat')}, type: 2}}\n"
    manager.add_script(maker, "unity/Runtime/Unity/Views/LinkView.cs", material)
    maker.write(MANAGER, manager.documents())


def make_node(maker):
    path = "unity/Prefabs/Node.prefab"
    node = GameObject(path, "Node", scale=(0.5, 0.5, 0.5))
    node.add(33, "MeshFilter", f"  m_Mesh: {{fileID: {SPHERE}, guid: {BUILT_IN_MESHES}, type: 0}}\n")
    node.add(23, "MeshRenderer", f"""  m_Enabled: 1
  m_CastShadows: 1
  m_ReceiveShadows: 1
  m_RenderingLayerMask: 1
  m_Materials:
  - {{fileID: 2100000, guid: {maker.guid('unity/Materials/Node.mat')}, type: 2}}
""")
    node.add(135, "SphereCollider", """  m_Material: {fileID: 0}
  m_IsTrigger: 0
  m_ProvidesContacts: 0
  m_Enabled: 1
  serializedVersion: 3
  m_Radius: 0.5
  m_Center: {x: 0, y: 0, z: 0}
""")
    # 112: rotation is frozen, so that a body that is driven does not roll.
    node.add(54, "Rigidbody", """  serializedVersion: 5
  m_Mass: 1
  m_LinearDamping: 0
  m_AngularDamping: 0.05
  m_UseGravity: 1
  m_IsKinematic: 0
  m_Interpolate: 0
  m_Constraints: 112
  m_CollisionDetection: 0
""")
    node.add_script(maker, "unity/Runtime/Unity/Nodes/Node.cs")
    node.add_script(maker, "unity/Runtime/Unity/Neighbourhoods/RadiusNeighbourhood.cs")
    maker.write(path, node.documents())


# What every scene begins with.
SCENE_SETTINGS = [
    document(29, 1, "OcclusionCullingSettings", "  m_ObjectHideFlags: 0\n  serializedVersion: 2\n  m_OcclusionCullingData: {fileID: 0}\n"),
    document(104, 2, "RenderSettings", """  m_ObjectHideFlags: 0
  serializedVersion: 10
  m_Fog: 0
  m_AmbientSkyColor: {r: 0.5, g: 0.52, b: 0.55, a: 1}
  m_AmbientIntensity: 1
  m_AmbientMode: 3
  m_SkyboxMaterial: {fileID: 0}
"""),
    document(157, 3, "LightmapSettings", """  m_ObjectHideFlags: 0
  serializedVersion: 13
  m_BakeOnSceneLoad: 0
  m_GISettings:
    serializedVersion: 2
    m_EnableBakedLightmaps: 0
    m_EnableRealtimeLightmaps: 0
  m_LightingDataAsset: {fileID: 0}
  m_LightingSettings: {fileID: 0}
"""),
]


def make_scene(maker, sample):
    """The scene of a sample that has a scenario: the same builder with the same fields, the same program, seed and times."""
    folder = f"unity/Samples~/{sample}"
    path = f"{folder}/{sample}.unity"
    with open(os.path.join(maker.root, folder, "scenario.json")) as file:
        scenario = json.load(file)
    position, down = CAMERAS.get(sample, CAMERA)
    camera = GameObject(path, "Main Camera", "MainCamera", position, tilted(down))
    camera.add(20, "Camera", """  m_Enabled: 1
  serializedVersion: 2
  m_ClearFlags: 2
  m_BackGroundColor: {r: 0.13, g: 0.14, b: 0.17, a: 0}
  near clip plane: 0.3
  far clip plane: 1000
  field of view: 50
  orthographic: 0
  m_Depth: -1
  m_CullingMask:
    serializedVersion: 2
    m_Bits: 4294967295
""")
    camera.add(81, "AudioListener", "  m_Enabled: 1\n")
    light = GameObject(path, "Directional Light", position=(0, 10, 0), rotation=(0.40821788, -0.23456968, 0.10938163, 0.8754261))
    light.add(108, "Light", """  m_Enabled: 1
  serializedVersion: 11
  m_Type: 1
  m_Color: {r: 1, g: 0.96, b: 0.88, a: 1}
  m_Intensity: 1
""")
    builder = GameObject(path, sample)
    fields = "".join(f"  {name}: {number(value)}\n" for name, value in scenario.get("fields", {}).items())
    builder.add_script(maker, f"{folder}/{scenario['scene'].split('.')[-1]}.cs", fields)
    instance = file_id(path, "Simulation Manager")
    roots = "".join(f"  - {{fileID: {root}}}\n" for root in [camera.transform, light.transform, instance, builder.transform])
    maker.write(path, [
        *SCENE_SETTINGS, *camera.documents(), *light.documents(),
        manager_instance(maker, instance, settings_of(maker, folder, scenario)), *builder.documents(),
        document(1660057539, 9223372036854775807, "SceneRoots", "  m_ObjectHideFlags: 0\n  m_Roots:\n" + roots),
    ])


def manager_instance(maker, number, settings):
    """The manager's prefab in a scene, with the scene's settings."""
    guid = maker.guid(MANAGER)
    component = file_id(MANAGER, "Simulation Manager/" + os.path.basename(MANAGER_SCRIPT))
    changes = {"jars.Array.size": 1, "jars.Array.data[0]": JAR, **settings}
    listed = "".join(f"""    - target: {{fileID: {component}, guid: {guid}, type: 3}}
      propertyPath: settings.{name}
      value: {value}
      objectReference: {{fileID: 0}}
""" for name, value in changes.items())
    return document(1001, number, "PrefabInstance", f"""  m_ObjectHideFlags: 0
  serializedVersion: 2
  m_Modification:
    serializedVersion: 3
    m_TransformParent: {{fileID: 0}}
    m_Modifications:
{listed}    m_RemovedComponents: []
    m_RemovedGameObjects: []
    m_AddedGameObjects: []
    m_AddedComponents: []
  m_SourcePrefab: {{fileID: {PREFAB}, guid: {guid}, type: 3}}
""")


def settings_of(maker, folder, scenario):
    """The manager's settings that the scenario names, by their names in C#."""
    settings = {"schema": schema_class(os.path.join(maker.root, folder, "Generated"))}
    for name in ["program", "seed", "deltaTime", "physicsStep", "threads"]:
        if name in scenario:
            settings[name] = scenario[name]
    for name, value in scenario.get("network", {}).items():
        settings[f"network.{name}"] = value
    return settings


def schema_class(folder):
    """The name of the generated schema class below a folder."""
    for where, _, names in os.walk(folder):
        for name in names:
            with open(os.path.join(where, name)) as file:
                match = re.search(r'override string Name => "([^"]+)"', file.read())
            if match:
                return match[1]
    raise ValueError(f"there is no schema class in {folder}; run ./collektive generate")


def number(value):
    """Numbers and switches as Unity writes them."""
    if not isinstance(value, (bool, int, float)):
        raise ValueError(f"{value!r}: only numbers and switches can be fields of a sample's scene")
    return int(value) if isinstance(value, bool) else f"{value:g}"


def tilted(degrees):
    """A rotation that looks down by so many degrees."""
    half = math.radians(degrees) / 2
    return round(math.sin(half), 7), 0, 0, round(math.cos(half), 7)


def make_all(root, out):
    maker = Maker(root, out)
    make_material(maker, "Node", "Surface", (0.27, 0.55, 0.85, 1))
    make_material(maker, "Link", "Link", (0.75, 0.75, 0.75, 1))
    make_manager(maker)
    make_node(maker)
    for sample in sorted(os.listdir(os.path.join(root, "unity/Samples~"))):
        if os.path.exists(os.path.join(root, "unity/Samples~", sample, "scenario.json")):
            make_scene(maker, sample)


if __name__ == "__main__":
    make_all(sys.argv[1], sys.argv[-1])
