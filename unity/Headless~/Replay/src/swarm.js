// Draws nodes and links. Textures contain the positions of two recorded frames, with one texel per slot. Vertex shaders interpolate between the two, so the
// time that scripts need per picture does not depend on the number of nodes.
import {
  BufferAttribute, BufferGeometry, CircleGeometry, DataTexture, DynamicDrawUsage, FloatType, FrontSide, InstancedBufferAttribute, InstancedBufferGeometry,
  LineSegments, Mesh, MeshDepthMaterial, MeshLambertMaterial, RGBAFormat, Sphere, SphereGeometry,
} from 'three';
import { TEXELS } from './recording.js';
import { Trails } from './trails.js';

const DETAILED_NODES = 3000; // more nodes than this have fewer triangles and no shadow
const OUTLINE = 1.16; // times the node's radius

const PLACES = /* glsl */`
uniform sampler2D here, next;
uniform float share, radius, halfLength;
vec4 texelOf(float slot) {
  ivec2 at = ivec2(int(slot) % ${TEXELS}, int(slot) / ${TEXELS});
  vec4 from = texelFetch(here, at, 0), to = texelFetch(next, at, 0);
  // Unity's z axis is mirrored. A node that is missing in the next frame does not move.
  return vec4(mix(from.xyz, to.xyz, to.w < 0.0 ? 0.0 : share) * vec3(1.0, 1.0, -1.0), from.w);
}
`;
// A shape is a sphere or an upright capsule. Its z axis points to the eye, so half of it is enough.
const NODE = /* glsl */`
attribute float slot;
varying vec3 tint;
// Converts a packed sRGB colour to linear light.
vec3 linear(float packed) {
  vec3 bytes = mod(floor(vec3(packed / 65536.0, packed / 256.0, packed)), 256.0) / 255.0;
  return mix(pow((bytes + 0.055) / 1.055, vec3(2.4)), bytes / 12.92, lessThanEqual(bytes, vec3(0.04045)));
}
vec3 facing(vec3 v, vec3 centre) {
  vec3 ahead = normalize(-(viewMatrix * vec4(centre, 1.0)).xyz);
  vec3 up = normalize(cross(ahead, vec3(1.0, 0.0, 0.0)));
  return mat3(cross(up, ahead), up, ahead) * v * mat3(viewMatrix);
}
vec3 bodyPoint(vec3 v, vec3 centre) {
  vec3 offset = facing(v, centre);
  return centre + radius * offset + vec3(0.0, sign(offset.y) * halfLength, 0.0);
}
`;

export class Swarm {
  /** `slots` and `links` are the maximum numbers that `show` can draw. `materials` are the theme's `outline`, `halo`, `link`, `accentLine` and `trail`. */
  constructor(scene, slots, links, materials) {
    this.colours = null; // see setColours
    this.detailed = slots <= DETAILED_NODES;
    const rows = Math.max(Math.ceil(slots / TEXELS), 1);
    this.textures = [0, 1].map(() => new DataTexture(null, TEXELS, rows, RGBAFormat, FloatType));
    this.uniforms = { here: { value: null }, next: { value: null }, share: { value: 0 }, radius: { value: 1 }, halfLength: { value: 0 } };

    // A half sphere that faces the light has no back side.
    const body = new MeshLambertMaterial({ shadowSide: FrontSide });
    for (const material of [body, materials.outline, materials.halo]) this.placeNodes(material);
    for (const material of [materials.link, materials.accentLine]) this.placeLines(material);
    const slotsShown = new InstancedBufferAttribute(new Float32Array(Math.max(slots, 1)), 1).setUsage(DynamicDrawUsage);
    const [sides, rings] = this.detailed ? [20, 4] : [12, 2];
    const shape = hemisphere(sides, rings);
    this.nodes = new Mesh(instanced(shape, slotsShown), body);
    if (this.detailed) {
      this.nodes.castShadow = true;
      this.nodes.customDepthMaterial = this.placeNodes(new MeshDepthMaterial());
    }
    // The selected node is drawn over nodes in front of it.
    const above = this.placeNodes(new MeshLambertMaterial({ depthTest: false, transparent: true }));
    this.selectedNode = new Mesh(instanced(shape, new InstancedBufferAttribute(new Float32Array(1), 1)), above);
    this.selectedNode.renderOrder = 3;
    // A disc behind the half sphere.
    const outline = new CircleGeometry(OUTLINE, sides).translate(0, 0, -0.1);
    this.outlines = new Mesh(instanced(outline, slotsShown), materials.outline);
    const halo = (size) => new Mesh(
      instanced(new SphereGeometry(1.5 * size, 20, 12), new InstancedBufferAttribute(new Float32Array(0), 1)), materials.halo);
    this.selectedHalo = halo(1.2);
    this.neighbourHalos = halo(0.92);
    this.links = linesOf(materials.link, links, 1);
    this.selectedLinks = linesOf(materials.accentLine, 0, 2);
    this.trails = new Trails(materials.trail);
    for (const object of [
      this.nodes, this.outlines, this.selectedNode, this.selectedHalo, this.neighbourHalos, this.links, this.selectedLinks, this.trails.object,
    ]) {
      object.frustumCulled = false;
      scene.add(object);
    }
  }

  /** Sets the drawn size in metres. `halfLength` is the distance between the centre of a capsule and the centres of its caps. */
  setSize(radius, halfLength) {
    this.uniforms.radius.value = radius;
    this.uniforms.halfLength.value = halfLength;
  }

  /** Sets the colours of nodes. For a frame, `colours` returns a function from slots to colours (0xRRGGBB). */
  setColours(colours) {
    this.colours = colours;
    for (const texture of this.textures) texture.frame = null;
    this.here = this.next = undefined;
  }

  /** Shows the time that is `share` of the way from one frame to the next. */
  show(here, next, share) {
    const { uniforms } = this;
    uniforms.share.value = share;
    if (this.here !== here || this.next !== next) {
      const [from, to] = this.load(here, next);
      uniforms.here.value = from;
      uniforms.next.value = to;
    }
    if (this.here !== here) {
      setSlots(this.nodes, here.slots);
      this.outlines.geometry.instanceCount = here.slots.length;
      setLines(this.links, here.pairs, here.ways);
    }
    this.here = here;
    this.next = next;
  }

  /** Marks a node with its current links; -1 for none. */
  select(slot) {
    const neighbours = slot < 0 ? [] : neighboursOf(this.here, slot);
    for (const mesh of [this.selectedNode, this.selectedHalo]) setSlots(mesh, slot < 0 ? [] : [slot]);
    setSlots(this.neighbourHalos, neighbours.map((neighbour) => neighbour.slot));
    setLines(this.selectedLinks, neighbours.flatMap((neighbour) => [slot, neighbour.slot]), neighbours.map(({ way }) => way));
  }

  /** Writes the drawn position of a slot in Unity's axes to `target`. */
  placeOf(slot, target) {
    const [from, to] = [this.here.places, this.next.places];
    const share = this.next.present[slot] ? this.uniforms.share.value : 0;
    for (let axis = 0; axis < 3; axis++) target[axis] = from[4 * slot + axis] + share * (share && to[4 * slot + axis] - from[4 * slot + axis]);
    return target;
  }

  /** Updates the textures of two frames. Textures that are already uploaded are reused. */
  load(here, next) {
    const find = (frame) => this.textures.find((texture) => texture.frame === frame);
    const free = (kept) => this.textures.find((texture) => texture !== kept);
    const from = find(here) ?? this.write(free(find(next)), here);
    return [from, find(next) ?? this.write(free(from), next)];
  }

  write(texture, frame) {
    texture.frame = frame;
    texture.image.data = frame.places;
    const colourOf = this.colours(frame);
    for (const slot of frame.slots) frame.places[4 * slot + 3] = colourOf(slot);
    texture.needsUpdate = true;
    return texture;
  }

  placeNodes(material) {
    return this.patch(material, (shader) => {
      shader.vertexShader = (PLACES + NODE + shader.vertexShader)
        .replace('void main() {', `void main() {
          vec4 texel = texelOf(slot);
          tint = linear(texel.w);`)
        .replace('#include <beginnormal_vertex>', 'vec3 objectNormal = facing(normal, texel.xyz);')
        .replace('#include <begin_vertex>', 'vec3 transformed = bodyPoint(position, texel.xyz);');
      if (material.isMeshLambertMaterial) {
        shader.fragmentShader = `varying vec3 tint;\n${shader.fragmentShader}`.replace('#include <color_fragment>', 'diffuseColor.rgb *= tint;');
      }
    });
  }

  placeLines(material) {
    return this.patch(material, (shader) => {
      // The x coordinate of a line's end is the slot of its node, or -1 - slot where a one-way link fades out.
      shader.vertexShader = (`${PLACES}varying float strength;\n${shader.vertexShader}`).replace('#include <begin_vertex>', `
        strength = position.x < 0.0 ? 0.0 : 1.0;
        vec3 transformed = texelOf(position.x < 0.0 ? -1.0 - position.x : position.x).xyz;`);
      shader.fragmentShader = `varying float strength;\n${shader.fragmentShader}`
        .replace('#include <color_fragment>', 'diffuseColor.a *= strength;');
    });
  }

  patch(material, change) {
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms);
      change(shader);
    };
    material.customProgramCacheKey = () => change.toString();
    return material;
  }
}

/** Returns the slots that are linked to a slot. `way` is 1 for a link to the neighbour, 2 for a link from it, and 3 for both. */
export function neighboursOf({ pairs, ways }, slot) {
  const found = [];
  for (let i = 0; i < pairs.length; i++) {
    if (pairs[i] !== slot) continue;
    const way = ways[i >> 1];
    found.push({ slot: pairs[i ^ 1], way: i % 2 === 1 && way < 3 ? 3 - way : way });
  }
  return found;
}

/** The visible half of a sphere. */
function hemisphere(sides, rings) {
  return new SphereGeometry(1, sides, rings, 0, 2 * Math.PI, 0, Math.PI / 2).rotateX(Math.PI / 2);
}

function instanced(shape, slots) {
  const geometry = new InstancedBufferGeometry();
  geometry.index = shape.index;
  geometry.setAttribute('position', shape.getAttribute('position'));
  geometry.setAttribute('normal', shape.getAttribute('normal'));
  geometry.setAttribute('slot', slots);
  geometry.instanceCount = 0;
  return geometry;
}

function linesOf(material, capacity, order) {
  const object = new LineSegments(new BufferGeometry(), material);
  object.geometry.setAttribute('position', new BufferAttribute(new Float32Array(2 * capacity), 1).setUsage(DynamicDrawUsage));
  object.geometry.boundingSphere = new Sphere(); // cannot be computed from slots
  object.renderOrder = order;
  return object;
}

function setSlots(mesh, slots) {
  write(mesh, 'slot', slots, InstancedBufferAttribute);
  mesh.geometry.instanceCount = slots.length;
}

/** Sets the lines of links. `ways` has the format of a frame. */
function setLines(object, pairs, ways) {
  const ends = new Float32Array(pairs.length);
  for (let i = 0; i < ends.length; i++) ends[i] = ways[i >> 1] === 2 - (i & 1) ? -1 - pairs[i] : pairs[i];
  write(object, 'position', ends, BufferAttribute);
  object.geometry.setDrawRange(0, pairs.length);
}

function write(object, name, values, Attribute) {
  let attribute = object.geometry.getAttribute(name);
  if (attribute.array.length < values.length) {
    object.geometry.dispose();
    attribute = new Attribute(new Float32Array(2 * values.length), 1).setUsage(DynamicDrawUsage);
    object.geometry.setAttribute(name, attribute);
  }
  attribute.array.set(values);
  attribute.clearUpdateRanges();
  if (values.length === 0) return;
  attribute.addUpdateRange(0, values.length);
  attribute.needsUpdate = true;
}
