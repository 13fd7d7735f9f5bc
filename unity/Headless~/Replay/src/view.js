// Draws the 3D picture. Input is in Unity's axes, and its z axis is mirrored here (FORMAT.md, Axes).
import {
  BackSide, BoxGeometry, BufferAttribute, BufferGeometry, CanvasTexture, CapsuleGeometry, Color, DirectionalLight, DoubleSide, EdgesGeometry,
  Group, HemisphereLight, LineBasicMaterial, LineSegments, Mesh, MathUtils, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, PlaneGeometry,
  RingGeometry,
  Scene, ShadowMaterial, SphereGeometry, Spherical, Sprite, SpriteMaterial, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { CSS2DObject, CSS2DRenderer } from 'three/examples/jsm/renderers/CSS2DRenderer.js';
import { Swarm } from './swarm.js';

const THEMES = {
  light: {
    background: '#eef1f4', floor: '#fbfcfd', grid: '#dfe4ea', border: '#b4bec9', shape: '#8793a3', edge: '#4d5967', outline: '#2f3a46',
    link: '#4a5a6e', linkOpacity: 0.3, shadow: 0.2, trail: '#33557a', accent: '#d6336c',
  },
  dark: {
    background: '#0d1014', floor: '#191e24', grid: '#262d35', border: '#48525e', shape: '#5d6875', edge: '#98a4b1', outline: '#c3ccd6',
    link: '#a9bacd', linkOpacity: 0.22, shadow: 0.5, trail: '#a9cdf5', accent: '#ff5c8a',
  },
};
const RING_PIXELS = 30; // minimum diameter of the mark of the selected node
const FOLLOWED_PIXELS = 12; // minimum radius of a followed node
const LINE_GAP = 0.012; // metres between the floor and its lines, to avoid flicker

export class View {
  /** Draws on the canvas of `holder`, and fills its labels. `slots` and `maxPairs` are the maximum numbers that `show` can draw. */
  constructor(holder, { metadata, movers, slots, maxPairs }) {
    this.holder = holder;
    const canvas = holder.querySelector('canvas');
    this.canvas = canvas;
    this.labels = new CSS2DRenderer({ element: holder.querySelector('.labels') });
    this.arena = {
      min: new Vector3(metadata.arena.min[0], metadata.arena.min[1], -metadata.arena.max[2]),
      max: new Vector3(metadata.arena.max[0], metadata.arena.max[1], -metadata.arena.min[2]),
    };
    this.radius = metadata.nodeRadius;
    this.halfLength = Math.max(metadata.nodeHeight / 2 - this.radius, 0);
    this.insets = { top: 0, bottom: 0, left: 0, right: 0 };
    this.onFrame = () => {};
    this.onDrawn = () => {};
    this.onMoved = () => {};
    this.follows = false;
    this.pending = null;
    this.framed = 'above'; // the predefined view of the camera, null once the user has moved it

    // With preserveDrawingBuffer, scripts can read the canvas at any time.
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true, powerPreference: 'high-performance' });
    this.renderer.shadowMap.enabled = true;
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(24, 1, 0.1, 1000);
    this.controls = new OrbitControls(this.camera, canvas);
    this.damped = !matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.controls.enableDamping = this.damped;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = Math.PI / 2 - 0.02;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => {
      this.onMoved();
      this.request();
    });
    this.controls.addEventListener('start', () => { this.framed = null; });

    this.materials = {
      floor: new MeshBasicMaterial({ side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }),
      shadow: new ShadowMaterial({ depthWrite: false }),
      grid: new LineBasicMaterial(),
      border: new LineBasicMaterial(),
      shape: new MeshLambertMaterial(),
      edge: new LineBasicMaterial(),
      outline: new MeshBasicMaterial(),
      link: new LineBasicMaterial({ transparent: true, depthWrite: false }),
      accent: new MeshBasicMaterial({ side: DoubleSide }),
      markerLine: new LineBasicMaterial(),
      accentLine: new LineBasicMaterial({ transparent: true }),
      ring: new SpriteMaterial({ map: ringTexture(), depthTest: false, sizeAttenuation: false }),
      halo: new MeshBasicMaterial({ side: BackSide }),
      trail: new LineBasicMaterial({ transparent: true, depthWrite: false, vertexColors: true }),
    };
    this.addLights();
    this.addFloor();
    for (const shape of metadata.shapes) this.place(this.addShape(shape), shape.centre, shape.rotation ?? [0, 0, 0, 1]);
    this.movers = movers.map(({ shape, poses }) => ({ object: this.addShape(shape), poses }));
    for (const marker of metadata.markers) this.addMarker(marker);
    this.swarm = new Swarm(this.scene, slots, maxPairs, this.materials);
    this.ring = new Sprite(this.materials.ring);
    this.ring.renderOrder = 3;
    this.ring.visible = false;
    this.scene.add(this.ring);
  }

  addLights() {
    const { min, max } = this.arena;
    const centre = min.clone().add(max).multiplyScalar(0.5);
    const reach = min.distanceTo(max) / 2;
    const sun = new DirectionalLight('#ffffff', 1.9);
    sun.position.copy(centre).add(new Vector3(-0.45, 1.2, 0.35).multiplyScalar(reach));
    sun.target.position.copy(centre);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.radius = 3;
    Object.assign(sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 3 * reach });
    this.scene.add(sun, sun.target, new HemisphereLight('#ffffff', '#7d8894', 1.7));
  }

  addFloor() {
    const { min, max } = this.arena;
    const width = max.x - min.x;
    const depth = max.z - min.z;
    for (const material of [this.materials.floor, this.materials.shadow]) {
      const plane = new Mesh(new PlaneGeometry(width, depth).rotateX(-Math.PI / 2), material);
      plane.position.set((min.x + max.x) / 2, min.y, (min.z + max.z) / 2);
      plane.receiveShadow = material === this.materials.shadow;
      this.scene.add(plane);
    }
    const step = [1, 2, 5].flatMap((n) => [-3, -2, -1, 0, 1, 2, 3, 4].map((e) => n * 10 ** e)).sort((a, b) => a - b)
      .find((length) => Math.max(width, depth) / length <= 20) ?? 1e5;
    this.gridStep = step;
    const points = [];
    const y = min.y + LINE_GAP;
    for (let x = Math.ceil(min.x / step) * step; x < max.x; x += step) points.push(x, y, min.z, x, y, max.z);
    for (let z = Math.ceil(min.z / step) * step; z < max.z; z += step) points.push(min.x, y, z, max.x, y, z);
    this.scene.add(lines(points, this.materials.grid));
    const border = [min.x, y, min.z, max.x, y, min.z, max.x, y, min.z, max.x, y, max.z, max.x, y, max.z, min.x, y, max.z, min.x, y, max.z, min.x, y, min.z];
    this.scene.add(lines(border, this.materials.border));
  }

  addShape(shape) {
    const geometry = geometryOf(shape);
    const mesh = new Mesh(geometry, this.materials.shape);
    mesh.castShadow = true;
    const group = new Group().add(mesh);
    if (shape.kind !== 'sphere') group.add(new LineSegments(new EdgesGeometry(geometry, 20), this.materials.edge));
    this.scene.add(group);
    return group;
  }

  place(object, [x, y, z], [qx, qy, qz, qw]) {
    object.position.set(x, y, -z);
    object.quaternion.set(-qx, -qy, qz, qw);
  }

  /** Moves the moving shapes to poses between two frames. */
  move(here, next, share) {
    for (const { object, poses } of this.movers) {
      const [from, after] = [here, next].map((index) => poses.slice(7 * index, 7 * index + 7));
      const exists = (pose) => pose.slice(3).some((number) => number !== 0);
      object.visible = exists(from);
      const to = exists(after) ? after : from;
      this.place(object, from, from.slice(3));
      const turn = object.quaternion.clone();
      const start = object.position.clone();
      this.place(object, to, to.slice(3));
      object.position.lerpVectors(start, object.position, share);
      object.quaternion.slerpQuaternions(turn, object.quaternion.clone(), share);
    }
  }

  addMarker({ name, position: [x, y, z] }) {
    const size = this.arena.min.distanceTo(this.arena.max) / 100;
    const top = new Vector3(x, y + 7 * size, -z);
    for (const radius of [0.55, 1]) {
      const ring = new Mesh(new RingGeometry(size * (radius - 0.16), size * radius, 48).rotateX(-Math.PI / 2), this.materials.accent);
      ring.position.set(x, y + 2 * LINE_GAP, -z);
      this.scene.add(ring);
    }
    this.scene.add(lines([x, y, -z, top.x, top.y, top.z], this.materials.markerLine));
    const label = document.createElement('div');
    label.className = 'marker';
    label.textContent = name;
    const object = new CSS2DObject(label);
    object.position.copy(top);
    object.center.set(0.5, 1);
    this.scene.add(object);
  }

  setTheme(name) {
    const theme = THEMES[name];
    this.theme = theme;
    this.scene.background = new Color(theme.background);
    for (const key of ['floor', 'grid', 'border', 'shape', 'edge', 'outline', 'link', 'accent', 'trail']) this.materials[key].color.set(theme[key]);
    for (const key of ['accentLine', 'markerLine', 'halo', 'ring']) this.materials[key].color.set(theme.accent);
    this.materials.shadow.opacity = theme.shadow;
    this.materials.link.opacity = theme.linkOpacity;
    this.request();
  }

  /** Fits the view to its area of the page. `insets` are the pixels that panels cover at each side. */
  resize(left, width, height, insets) {
    Object.assign(this.holder.style, { left: `${left}px`, width: `${width}px` });
    this.insets = insets;
    this.width = width;
    this.height = height;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.labels.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.setViewOffset(width, height, (insets.right - insets.left) / 2, (insets.bottom - insets.top) / 2, width, height);
    if (this.framed) this.frame(this.framed);
    this.request();
  }

  /** Shows the whole arena. `from` is 'above' for a view at an angle, or 'top'. */
  frame(from) {
    this.framed = from;
    this.controls.enableDamping = false; // stops the remaining rotation
    this.controls.update();
    const { min, max } = this.arena;
    const target = new Vector3((min.x + max.x) / 2, min.y, (min.z + max.z) / 2);
    // Looking straight down would leave the rotation undefined.
    const direction = from === 'top' ? new Vector3(0, 1, 1e-4) : new Vector3(0, 1.3, 1).normalize();
    const corners = [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) => new Vector3(x, y, z))));
    const { top, bottom, left, right } = this.insets;
    const [freeX, freeY] = [1 - (left + right) / this.width, 1 - (top + bottom) / this.height];
    const fits = (distance) => {
      this.camera.position.copy(target).addScaledVector(direction, distance);
      this.camera.near = distance / 100;
      this.camera.far = distance * 10;
      this.camera.lookAt(target);
      this.camera.updateProjectionMatrix();
      this.camera.updateMatrixWorld();
      const [shiftX, shiftY] = [(left - right) / this.width, (bottom - top) / this.height];
      return corners.every((corner) => {
        const seen = corner.clone().project(this.camera);
        return seen.z < 1 && Math.abs(seen.x - shiftX) < 0.96 * freeX && Math.abs(seen.y - shiftY) < 0.97 * freeY;
      });
    };
    let near = 0;
    let far = min.distanceTo(max) * 20;
    for (let i = 0; i < 30; i++) {
      const middle = (near + far) / 2;
      if (fits(middle)) far = middle;
      else near = middle;
    }
    fits(far);
    this.controls.target.copy(target);
    this.controls.minDistance = far / 60;
    this.controls.maxDistance = far * 4;
    this.controls.update();
    this.controls.enableDamping = this.damped;
    this.request();
  }

  /** Turns the camera about its target by radians, or moves it nearer (`zoom` < 1). */
  turn(aside, up, zoom) {
    this.framed = null;
    const { minDistance, maxDistance, maxPolarAngle, target } = this.controls;
    const from = new Spherical().setFromVector3(this.camera.position.clone().sub(target));
    from.radius = MathUtils.clamp(from.radius * zoom, minDistance, maxDistance);
    from.phi = MathUtils.clamp(from.phi - up, 1e-4, maxPolarAngle);
    from.theta += aside;
    this.camera.position.setFromSpherical(from).add(target);
    this.controls.update();
    this.request();
  }

  /** Returns the metres that a pixel covers at a distance of one metre from the eye. */
  get pixel() {
    return (2 * Math.tan((this.camera.fov * Math.PI) / 360)) / this.height;
  }

  /** Returns the pixels that a node's radius covers in the middle of the picture when drawn at its real size. */
  get nodePixels() {
    return this.radius / (this.pixel * this.camera.position.distanceTo(this.controls.target));
  }

  /** Copies the camera of another view of the same size. */
  lookAs(other) {
    const [camera, of] = [this.camera, other.camera];
    if (camera.position.equals(of.position) && this.controls.target.equals(other.controls.target)) return;
    camera.position.copy(of.position);
    this.controls.target.copy(other.controls.target);
    this.framed = other.framed;
    this.request();
  }

  /**
   * Shows a time between the frames `here` and `next`, where `share` is 0 for `here` and 1 for `next`. `selected` is a slot or -1, `factor`
   * scales nodes, and `links` is 'all', 'none', or 'selected' for links of the selected node.
   */
  show({ here, next, share, links, selected, factor }) {
    const { swarm } = this;
    const changed = swarm.here !== here;
    swarm.show(here, next, share);
    swarm.setSize(this.radius * factor, this.halfLength * factor);
    this.ring.visible = selected >= 0;
    if (selected >= 0) this.pointOf(selected, this.ring.position);
    if (changed || this.selected !== selected) swarm.select(selected);
    this.selected = selected;
    swarm.links.visible = links === 'all';
    swarm.selectedLinks.visible = links !== 'none';
    this.materials.link.opacity = this.theme.linkOpacity * (selected < 0 ? 1 : 0.4);
    this.move(here.index, next.index, share);
    if (this.follows && selected >= 0) this.keepWith(selected);
    this.request();
  }

  /** Sets whether the camera follows the selected node. */
  setFollows(follows) {
    this.follows = follows;
    if (follows && this.selected >= 0) {
      this.keepWith(this.selected);
      const drawn = (this.nodePixels * this.swarm.uniforms.radius.value) / this.radius;
      this.turn(0, 0, Math.min(drawn / FOLLOWED_PIXELS, 1));
    }
    this.request();
  }

  /** Returns the drawn position of a slot in the picture's axes. */
  pointOf(slot, point) {
    point.fromArray(this.swarm.placeOf(slot, [0, 0, 0]));
    point.z = -point.z;
    return point;
  }

  keepWith(slot) {
    this.framed = null;
    const point = this.pointOf(slot, new Vector3());
    this.camera.position.add(point).sub(this.controls.target);
    this.controls.target.copy(point);
  }

  /** Returns the point of the floor at a point of the canvas, in Unity's axes. */
  floorAt(x, y) {
    const ray = new Vector3((2 * x) / this.width - 1, 1 - (2 * y) / this.height, 0.5).unproject(this.camera).sub(this.camera.position);
    const distance = (this.arena.min.y - this.camera.position.y) / Math.min(ray.y, -1e-6);
    const point = this.camera.position.clone().addScaledVector(ray, distance);
    return [point.x, point.y, -point.z];
  }

  /** Returns the slot of the node nearest to a point of the canvas, or -1 if no node is within the reach of a finger. */
  pick(x, y) {
    const { here, uniforms } = this.swarm;
    const point = new Vector3();
    let best = -1;
    let bestScore = Infinity;
    for (const slot of here.slots) {
      this.pointOf(slot, point);
      const depth = point.distanceTo(this.camera.position);
      point.project(this.camera);
      if (point.z > 1) continue;
      const distance = Math.hypot(((point.x + 1) / 2) * this.width - x, ((1 - point.y) / 2) * this.height - y);
      const reach = Math.max(uniforms.radius.value / (this.pixel * depth), 9);
      // Prefer the front node at the point, otherwise the nearest node on the screen.
      const score = distance <= reach ? distance / reach + depth * 1e-3 : Infinity;
      if (score < bestScore) {
        best = slot;
        bestScore = score;
      }
    }
    return best;
  }

  /** Requests a redraw. Several calls before the redraw request only one. */
  request() {
    this.pending ??= requestAnimationFrame((now) => {
      this.pending = null;
      this.onFrame(now); // may request the next picture
      this.render();
    });
  }

  /** Draws immediately, and cancels a requested redraw. */
  draw() {
    cancelAnimationFrame(this.pending);
    this.pending = null;
    this.render();
  }

  render() {
    this.controls.update();
    const radius = 1.9 * this.swarm.uniforms.radius.value + this.swarm.uniforms.halfLength.value;
    this.ring.scale.setScalar(Math.max(RING_PIXELS * this.pixel, (2 * radius) / this.camera.position.distanceTo(this.ring.position)));
    this.renderer.render(this.scene, this.camera);
    this.labels.render(this.scene, this.camera);
    this.onDrawn();
  }

  dispose() {
    cancelAnimationFrame(this.pending);
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss(); // browsers limit the number of contexts
    this.holder.remove();
  }
}

function ringTexture() {
  const canvas = new OffscreenCanvas(128, 128);
  const context = canvas.getContext('2d');
  context.strokeStyle = '#fff';
  context.lineWidth = 10;
  context.arc(64, 64, 58, 0, 2 * Math.PI);
  context.stroke();
  return new CanvasTexture(canvas);
}

function lines(points, material) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
  return new LineSegments(geometry, material);
}

function geometryOf(shape) {
  if (shape.kind === 'sphere') return new SphereGeometry(shape.radius, 48, 32);
  if (shape.kind === 'capsule') {
    const capsule = new CapsuleGeometry(shape.radius, Math.max(shape.height - 2 * shape.radius, 0), 16, 48);
    return [() => capsule.rotateZ(Math.PI / 2), () => capsule, () => capsule.rotateX(Math.PI / 2)][shape.axis]();
  }
  if (shape.kind === 'box') return new BoxGeometry(...shape.size);
  const geometry = new BufferGeometry();
  const points = new Float32Array(shape.vertices).map((x, i) => (i % 3 === 2 ? -x : x));
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  // Mirroring reverses the order of a triangle's corners.
  geometry.setIndex(shape.triangles.map((_, i) => shape.triangles[3 * Math.floor(i / 3) + 2 - (i % 3)]));
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  return flat;
}
