"""Checks the passes of shaders, and that Unity does not strip the components and shader variants that scripts of samples use."""
import os
import re
from collections.abc import Iterator

from validator import unity_yaml
from validator.assets import Assets

# The components of each primitive: Unity's class numbers of its mesh filter, renderer and collider.
PRIMITIVES = {"Sphere": {33, 23, 135}, "Cube": {33, 23, 65}, "Capsule": {33, 23, 136}, "Cylinder": {33, 23, 136}, "Plane": {33, 23, 64}, "Quad": {33, 23, 64}}


def problems(assets: Assets) -> Iterator[str]:
    for path in assets.with_ending(".cs"):
        if re.search(r"enableInstancing = true", assets.read(path)):
            yield f"{path}: enables instancing at run time; Unity strips the shader variants unless a material asset enables instancing"
    for path in assets.with_ending(".shader"):
        for light_mode in ("DepthOnly", "ShadowCaster"):
            if f'"LightMode" = "{light_mode}"' not in assets.read(path):
                yield f"{path}: has no pass {light_mode}, so its surfaces are missing in depth textures or shadows"
    for scene in assets.with_ending(".unity"):
        folder = os.path.dirname(scene)
        code = "".join(assets.read(path) for path in assets.with_ending(".cs") if os.path.dirname(path) == folder)
        names = set(re.findall(r"PrimitiveType\.(\w+)", code)) | ({"Cube"} if "MakeBox(" in code else set())
        try:
            present = {document.class_id for document in unity_yaml.read(os.path.join(assets.root, scene))}
        except unity_yaml.UnityYamlError:
            # references.py reports that the scene is not valid.
            continue
        for name in sorted(names):
            if missing := PRIMITIVES[name] - present:
                yield f"{scene}: scripts create a {name}, but the scene has no component of class {', '.join(map(str, sorted(missing)))}"
