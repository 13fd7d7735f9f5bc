using System;
using System.Collections;
using System.Collections.Generic;
using System.Runtime.CompilerServices;
using UnityEngine.SceneManagement;

namespace UnityEngine
{
    public enum Space
    {
        World = 0,
        Self = 1,
    }

    /// Position, rotation and scale relative to the parent; world values are computed on access.
    public class Transform : Component, IEnumerable
    {
        internal readonly List<Transform> children = new List<Transform>();
        internal Transform parentOrNull;

        /// Whether this transform is in the list of transforms that changed since the last physics sync.
        internal bool awaitsSync;

        /// Whether its position or rotation changed, not only its scale.
        internal bool awaitsPoseSync;

        /// Whether the pose of this transform, or one of its parents, changed since the last physics sync.
        internal bool IsBeforeSync => awaitsPoseSync || !(parentOrNull is null) && (parentOrNull.awaitsSync || parentOrNull.IsBeforeSync);

        Vector3 placed = Vector3.zero;
        Quaternion turned = Quaternion.identity;
        Vector3 ownScale = Vector3.one;
        static long changes = 1;
        // The numbers of the last change and of the last change that `hasChanged = false` has hidden.
        long lastChange = 1, lastSeen;
        // PhysX's handle of the object's active body, if any, and the step in which the pose was copied from the body.
        int body = Physx.None;
        int bodyStep;

        protected internal Transform() { }

        Vector3 ownPosition
        {
            get
            {
                ThrowIfDestroyed();
                return !IsBehind ? placed : parentOrNull is null ? Motion.Pose.Position : Followed().placed;
            }
            set
            {
                Follow();
                placed = value;
            }
        }

        Quaternion ownRotation
        {
            get
            {
                ThrowIfDestroyed();
                return !IsBehind ? turned : parentOrNull is null ? Motion.Pose.Rotation : Followed().turned;
            }
            set
            {
                Follow();
                turned = value;
            }
        }

        public bool hasChanged
        {
            get => Existing.HasChangedSince(lastSeen);
            set
            {
                for (var level = Existing; !(level is null); level = level.parentOrNull) level.Follow();
                lastSeen = value ? 0 : changes;
            }
        }

        /// Number of changes of all transforms.
        internal static long Changes => changes;

        /// Whether this transform or one of its parents has changed since there were this number of changes.
        internal bool HasChangedSince(long count)
        {
            for (var level = this; !(level is null); level = level.parentOrNull)
                if (level.IsBehind || level.lastChange > count) return true;
            return false;
        }

        unsafe ref Physx.Motion Motion => ref PhysicsWorld.Motions[body];

        /// Whether a physics step has moved the body since its pose was last copied.
        bool IsBehind
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => body != Physx.None && Motion.Step != bodyStep;
        }

        /// Copies the pose of the body if a physics step has moved the body.
        internal void Follow()
        {
            if (IsBehind) Place(Motion.Pose.Position, Motion.Pose.Rotation);
        }

        /// Keeps the transform's pose although a physics step reported one for the body.
        internal void SkipStep() => bodyStep = Motion.Step;

        /// Whether the last physics step moved a body above this transform.
        internal bool HasMovedParent
        {
            get
            {
                for (var parent = parentOrNull; !(parent is null); parent = parent.parentOrNull)
                    if (parent.body != Physx.None && parent.Motion.Step == PhysicsWorld.StepCount) return true;
                return false;
            }
        }

        /// This transform. Throws an exception if it is destroyed.
        Transform Existing
        {
            get
            {
                ThrowIfDestroyed();
                return this;
            }
        }

        Transform Followed()
        {
            Follow();
            return this;
        }

        /// Sets the body whose pose the transform follows, or none.
        internal void Follow(int actor)
        {
            Follow();
            body = actor;
            bodyStep = body == Physx.None ? 0 : Motion.Step;
        }

        void Changed(bool isPose = true)
        {
            ThrowIfDestroyed();
            lastChange = ++changes;
            PhysicsWorld.TransformChanged(this, isPose);
        }

        // ---- Local ----------------------------------------------------------------------------------------------------

        public Vector3 localPosition
        {
            get => ownPosition;
            set
            {
                if (!Finite.Accepts(value, "transform.position", this)) return;
                ownPosition = value;
                Changed();
            }
        }

        public Quaternion localRotation
        {
            get => ownRotation;
            set
            {
                if (!Finite.Accepts(value, "transform.rotation", this)) return;
                ownRotation = value.normalized;
                Changed();
            }
        }

        public Vector3 localScale
        {
            get
            {
                ThrowIfDestroyed();
                return ownScale;
            }
            set
            {
                if (!Finite.Accepts(value, "transform.localScale", this)) return;
                ownScale = value;
                Changed(false);
            }
        }

        public Vector3 localEulerAngles { get => ownRotation.eulerAngles; set => localRotation = Quaternion.Euler(value); }

        public void SetLocalPositionAndRotation(Vector3 localPosition, Quaternion localRotation)
        {
            this.localPosition = localPosition;
            this.localRotation = localRotation;
        }

        public void GetLocalPositionAndRotation(out Vector3 localPosition, out Quaternion localRotation)
        {
            localPosition = ownPosition;
            localRotation = ownRotation;
        }

        // ---- World ----------------------------------------------------------------------------------------------------

        public Vector3 position
        {
            get => parentOrNull is null ? ownPosition : parentOrNull.TransformPoint(ownPosition);
            set => localPosition = parentOrNull is null ? value : parentOrNull.InverseTransformPoint(value);
        }

        public Quaternion rotation
        {
            get => parentOrNull is null ? ownRotation : parentOrNull.rotation * parentOrNull.Mirror(ownRotation);
            set => localRotation = parentOrNull is null ? value : parentOrNull.Mirror(Quaternion.Inverse(parentOrNull.rotation) * value);
        }

        /// Returns a child's rotation, mirrored along the axes in which this object and its parents have a negative scale. A second call undoes the first.
        Quaternion Mirror(Quaternion turn)
        {
            bool x = false, y = false, z = false;
            for (var level = this; !(level is null); level = level.parentOrNull)
            {
                x ^= level.ownScale.x < 0f;
                y ^= level.ownScale.y < 0f;
                z ^= level.ownScale.z < 0f;
            }
            return new Quaternion(y ^ z ? -turn.x : turn.x, x ^ z ? -turn.y : turn.y, x ^ y ? -turn.z : turn.z, turn.w);
        }

        public Vector3 eulerAngles { get => rotation.eulerAngles; set => rotation = Quaternion.Euler(value); }
        public Vector3 right { get => rotation * Vector3.right; set => rotation = Quaternion.FromToRotation(Vector3.right, value); }
        public Vector3 up { get => rotation * Vector3.up; set => rotation = Quaternion.FromToRotation(Vector3.up, value); }
        public Vector3 forward { get => rotation * Vector3.forward; set => rotation = Quaternion.LookRotation(value); }

        public void SetPositionAndRotation(Vector3 position, Quaternion rotation)
        {
            if (!Finite.Accepts(position, "transform.position", this) || !Finite.Accepts(rotation, "transform.rotation", this)) return;
            Place(position, rotation.normalized);
            Changed();
        }

        public void GetPositionAndRotation(out Vector3 position, out Quaternion rotation)
        {
            position = this.position;
            rotation = this.rotation;
        }

        /// Sets the pose to the result of a physics step, without notifying physics. The rotation must be normalised.
        internal void Place(in Vector3 position, in Quaternion rotation)
        {
            lastChange = ++changes;
            if (body != Physx.None) bodyStep = Motion.Step;
            if (parentOrNull is null)
            {
                placed = position;
                turned = rotation;
                return;
            }
            placed = parentOrNull.InverseTransformPoint(position);
            turned = parentOrNull.Mirror(Quaternion.Inverse(parentOrNull.rotation) * rotation).normalized;
        }

        /// The world scale along the local axes, without shear.
        public Vector3 lossyScale
        {
            get
            {
                if (parentOrNull is null) return localScale;
                var unturn = Quaternion.Inverse(rotation);
                return new Vector3(
                    (unturn * TransformVector(Vector3.right)).x,
                    (unturn * TransformVector(Vector3.up)).y,
                    (unturn * TransformVector(Vector3.forward)).z);
            }
        }

        public Matrix4x4 localToWorldMatrix
        {
            get
            {
                var local = Matrix4x4.TRS(ownPosition, ownRotation, ownScale);
                return parentOrNull is null ? local : parentOrNull.localToWorldMatrix * local;
            }
        }

        // Not the inverse of localToWorldMatrix, which does not exist if a scale is 0.
        public Matrix4x4 worldToLocalMatrix
        {
            get
            {
                Vector4 origin = InverseTransformPoint(Vector3.zero);
                origin.w = 1f;
                return new Matrix4x4(
                    InverseTransformVector(Vector3.right), InverseTransformVector(Vector3.up), InverseTransformVector(Vector3.forward), origin);
            }
        }

        // ---- Conversions ----------------------------------------------------------------------------------------------

        public Vector3 TransformPoint(Vector3 position)
        {
            for (var level = this; !(level is null); level = level.parentOrNull)
                position = level.ownPosition + level.ownRotation * Vector3.Scale(level.ownScale, position);
            return position;
        }

        public Vector3 TransformVector(Vector3 vector)
        {
            for (var level = this; !(level is null); level = level.parentOrNull)
                vector = level.ownRotation * Vector3.Scale(level.ownScale, vector);
            return vector;
        }

        public Vector3 InverseTransformPoint(Vector3 position)
        {
            if (!(parentOrNull is null)) position = parentOrNull.InverseTransformPoint(position);
            return Unscale(Quaternion.Inverse(ownRotation) * (position - ownPosition));
        }

        public Vector3 InverseTransformVector(Vector3 vector)
        {
            if (!(parentOrNull is null)) vector = parentOrNull.InverseTransformVector(vector);
            return Unscale(Quaternion.Inverse(ownRotation) * vector);
        }

        /// Divides by the scale. As in Unity, the result is 0 along axes with a scale of 0.
        Vector3 Unscale(Vector3 vector) => new Vector3(Unscale(vector.x, ownScale.x), Unscale(vector.y, ownScale.y), Unscale(vector.z, ownScale.z));

        static float Unscale(float value, float scale) => scale == 0f ? 0f : value / scale;

        public Vector3 TransformPoint(float x, float y, float z) => TransformPoint(new Vector3(x, y, z));
        public Vector3 TransformVector(float x, float y, float z) => TransformVector(new Vector3(x, y, z));
        public Vector3 InverseTransformPoint(float x, float y, float z) => InverseTransformPoint(new Vector3(x, y, z));
        public Vector3 InverseTransformVector(float x, float y, float z) => InverseTransformVector(new Vector3(x, y, z));
        public Vector3 TransformDirection(Vector3 direction) => rotation * direction;
        public Vector3 TransformDirection(float x, float y, float z) => TransformDirection(new Vector3(x, y, z));
        public Vector3 InverseTransformDirection(Vector3 direction) => Quaternion.Inverse(rotation) * direction;
        public Vector3 InverseTransformDirection(float x, float y, float z) => InverseTransformDirection(new Vector3(x, y, z));

        // ---- Movement -------------------------------------------------------------------------------------------------

        public void Translate(Vector3 translation) => Translate(translation, Space.Self);
        public void Translate(Vector3 translation, Space relativeTo) =>
            position += relativeTo == Space.World ? translation : TransformDirection(translation);
        public void Translate(float x, float y, float z) => Translate(new Vector3(x, y, z));
        public void Translate(float x, float y, float z, Space relativeTo) => Translate(new Vector3(x, y, z), relativeTo);

        public void Rotate(Vector3 eulers) => Rotate(eulers, Space.Self);
        public void Rotate(float xAngle, float yAngle, float zAngle) => Rotate(new Vector3(xAngle, yAngle, zAngle));
        public void Rotate(float xAngle, float yAngle, float zAngle, Space relativeTo) => Rotate(new Vector3(xAngle, yAngle, zAngle), relativeTo);
        public void Rotate(Vector3 axis, float angle) => Rotate(axis, angle, Space.Self);
        public void Rotate(Vector3 axis, float angle, Space relativeTo) => Turn(Quaternion.AngleAxis(angle, axis), relativeTo);
        public void Rotate(Vector3 eulers, Space relativeTo) => Turn(Quaternion.Euler(eulers), relativeTo);

        void Turn(Quaternion turn, Space relativeTo)
        {
            if (relativeTo == Space.Self) localRotation = ownRotation * turn;
            else rotation = turn * rotation;
        }

        public void RotateAround(Vector3 point, Vector3 axis, float angle)
        {
            var turn = Quaternion.AngleAxis(angle, axis);
            SetPositionAndRotation(point + turn * (position - point), turn * rotation);
        }

        public void LookAt(Transform target) => LookAt(target, Vector3.up);
        public void LookAt(Transform target, Vector3 worldUp)
        {
            if (target) LookAt(target.position, worldUp);
        }

        public void LookAt(Vector3 worldPosition) => LookAt(worldPosition, Vector3.up);

        /// Turns the object towards a position. As in Unity, it keeps its rotation if it is at that position.
        public void LookAt(Vector3 worldPosition, Vector3 worldUp)
        {
            var direction = worldPosition - position;
            if (direction.normalized.sqrMagnitude > 0f) rotation = Quaternion.LookRotation(direction, worldUp);
        }

        // ---- Hierarchy ------------------------------------------------------------------------------------------------

        public Transform parent { get => Existing.parentOrNull; set => SetParent(value); }
        public void SetParent(Transform p) => SetParent(p, true);

        public void SetParent(Transform parent, bool worldPositionStays)
        {
            ThrowIfDestroyed();
            if (!parent) parent = null;
            var changing = Lifecycle.IsChanging(parentOrNull) ? parentOrNull : Lifecycle.IsChanging(parent) ? parent : null;
            if (changing is null || ReferenceEquals(parent, parentOrNull))
            {
                Join(parent, worldPositionStays);
                return;
            }
            Debug.LogError($"Cannot set the parent of the GameObject '{name}' while activating or deactivating the parent GameObject '{changing.name}'.", this);
        }

        /// Changes the parent even while the parent is being activated, as `Instantiate` does.
        internal void Join(Transform parent, bool worldPositionStays)
        {
            if (ReferenceEquals(parent, parentOrNull)) return;
            if (owner.isBeingDestroyed || !(parent is null) && parent.owner.isBeingDestroyed)
            {
                Debug.LogError($"Cannot set the parent of the GameObject '{name}' while it or its new parent is being destroyed.", this);
                return;
            }
            if (!(parent is null) && parent.IsChildOf(this))
            {
                Debug.LogError($"'{parent.name}' cannot become the parent of '{name}', which is one of its ancestors.", this);
                return;
            }
            Follow();
            var worldPosition = position;
            var worldRotation = rotation;
            Vector3 x = TransformVector(Vector3.right), y = TransformVector(Vector3.up), z = TransformVector(Vector3.forward);
            var scene = owner.scene;
            var previous = parentOrNull;
            Detach();
            parentOrNull = parent;
            owner.sceneOfRoot = scene;
            Attach(int.MaxValue);
            if (worldPositionStays)
            {
                Place(worldPosition, worldRotation.normalized);
                ownScale = Vector3.one;
                ownScale = new Vector3(InverseTransformVector(x).x, InverseTransformVector(y).y, InverseTransformVector(z).z);
            }
            owner.RefreshActivity();
            PhysicsWorld.HierarchyChanged(this);
            Changed();
            if (owner.activeInHierarchy)
                foreach (var script in owner.GetComponentsInChildren<MonoBehaviour>()) Messages.Send(script.messages.OnTransformParentChanged, script);
            previous?.ChildrenChanged();
            parent?.ChildrenChanged();
        }

        /// Sends OnTransformChildrenChanged to this object's scripts.
        internal void ChildrenChanged()
        {
            // A script can have destroyed the object in another message.
            if (!owner || !owner.activeInHierarchy) return;
            for (var index = 0; index < owner.components.Count; index++)
                if (owner.components[index] is MonoBehaviour script) Messages.Send(script.messages.OnTransformChildrenChanged, script);
        }

        /// Removes the object from its parent's children or from the scene's roots.
        internal void Detach()
        {
            if (parentOrNull is null) owner.sceneOfRoot.Roots.Remove(owner);
            else parentOrNull.children.Remove(this);
        }

        void Attach(int index)
        {
            if (parentOrNull is null) owner.sceneOfRoot.Roots.Insert(Math.Min(index, owner.sceneOfRoot.rootCount), owner);
            else parentOrNull.children.Insert(Math.Min(index, parentOrNull.children.Count), this);
        }

        public Transform root => Existing.parentOrNull is null ? this : parentOrNull.root;
        public int childCount => Existing.children.Count;
        public Transform GetChild(int index) => Existing.children[index];

        /// Finds a child or, by its path, a descendant. As in Unity, ".." is the parent, "" this object, and a path with a leading slash begins at a root.
        public Transform Find(string n)
        {
            ThrowIfDestroyed();
            if (n.Length == 0 || n[0] != '/') return FindFrom(n);
            foreach (var root in Scene.AllRoots())
            {
                var start = "/" + root.name;
                if (n == start) return root.transform;
                if (n.StartsWith(start + "/", StringComparison.Ordinal) && root.transform.FindFrom(n.Substring(start.Length + 1)) is Transform found)
                    return found;
            }
            return null;
        }

        Transform FindFrom(string path)
        {
            if (path.Length == 0) return this;
            var slash = path.IndexOf('/');
            var first = slash < 0 ? path : path.Substring(0, slash);
            var rest = slash < 0 ? "" : path.Substring(slash + 1);
            if (first == "..") return parentOrNull?.FindFrom(rest);
            foreach (var child in children)
                if (child.NameImpl == first && child.FindFrom(rest) is Transform found) return found;
            return null;
        }

        public bool IsChildOf(Transform parent)
        {
            if (parent is null) throw new ArgumentNullException(nameof(parent));
            for (var level = Existing; !(level is null); level = level.parentOrNull)
                if (ReferenceEquals(level, parent)) return true;
            return false;
        }

        public void DetachChildren()
        {
            foreach (var child in Existing.children.ToArray()) child.SetParent(null);
        }

        public int GetSiblingIndex() => parent is null ? owner.sceneOfRoot.Roots.IndexOf(owner) : parentOrNull.children.IndexOf(this);
        public void SetAsFirstSibling() => SetSiblingIndex(0);
        public void SetAsLastSibling() => SetSiblingIndex(int.MaxValue);

        public void SetSiblingIndex(int index)
        {
            var before = GetSiblingIndex();
            if (index < 0) throw new ArgumentOutOfRangeException(nameof(index), index, "A sibling index must not be negative.");
            Detach();
            Attach(index);
            if (GetSiblingIndex() != before) parentOrNull?.ChildrenChanged();
        }

        /// Enumerates by index. As in Unity, children can be added and removed meanwhile.
        public IEnumerator GetEnumerator()
        {
            for (var index = 0; index < childCount; index++) yield return children[index];
        }

        internal override void CopyFrom(Component original)
        {
            var other = (Transform)original;
            ownPosition = other.ownPosition;
            ownRotation = other.ownRotation;
            ownScale = other.ownScale;
        }
    }
}
