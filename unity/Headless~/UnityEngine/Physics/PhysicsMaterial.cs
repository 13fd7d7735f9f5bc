namespace UnityEngine
{
    public enum PhysicsMaterialCombine
    {
        Average = 0,
        Multiply,
        Minimum,
        Maximum,
    }

    public class PhysicsMaterial : Object
    {
        /// The values of colliders without a material. A struct, because creating an object would change the hash codes of the first run.
        internal static readonly Physx.Material Defaults = new Physx.Material { StaticFriction = 0.6f, DynamicFriction = 0.6f };

        /// Number of changes of all materials. Colliders check their materials when it increases.
        internal static int Changes { get; private set; }

        Physx.Material values = Defaults;

        public PhysicsMaterial() { }
        public PhysicsMaterial(string name) => NameImpl = name;

        internal Physx.Material Values
        {
            get => values;
            set
            {
                values = value;
                Changes++;
            }
        }

        public float bounciness { get => this.Existing().values.Bounciness; set => Set(ref values.Bounciness, Mathf.Clamp01(value)); }
        public float dynamicFriction { get => this.Existing().values.DynamicFriction; set => Set(ref values.DynamicFriction, Mathf.Max(0f, value)); }
        public float staticFriction { get => this.Existing().values.StaticFriction; set => Set(ref values.StaticFriction, Mathf.Max(0f, value)); }

        public PhysicsMaterialCombine frictionCombine
        {
            get => FromPhysx(this.Existing().values.FrictionCombine);
            set => Set(ref values.FrictionCombine, ToPhysx(value));
        }

        public PhysicsMaterialCombine bounceCombine
        {
            get => FromPhysx(this.Existing().values.BounceCombine);
            set => Set(ref values.BounceCombine, ToPhysx(value));
        }

        void Set<T>(ref T field, T value)
        {
            ThrowIfDestroyed();
            field = value;
            Changes++;
        }

        static Physx.Combine ToPhysx(PhysicsMaterialCombine mode) => mode switch
        {
            PhysicsMaterialCombine.Multiply => Physx.Combine.Multiply,
            PhysicsMaterialCombine.Minimum => Physx.Combine.Minimum,
            PhysicsMaterialCombine.Maximum => Physx.Combine.Maximum,
            _ => Physx.Combine.Average,
        };

        static PhysicsMaterialCombine FromPhysx(Physx.Combine mode) => mode switch
        {
            Physx.Combine.Multiply => PhysicsMaterialCombine.Multiply,
            Physx.Combine.Minimum => PhysicsMaterialCombine.Minimum,
            Physx.Combine.Maximum => PhysicsMaterialCombine.Maximum,
            _ => PhysicsMaterialCombine.Average,
        };
    }
}
