namespace UnityEngine
{
    public enum PhysicsMaterialCombine
    {
        Average = 0,
        Multiply,
        Minimum,
        Maximum,
    }

    /// `staticFriction` is kept but not simulated: contacts use `dynamicFriction` also at rest.
    public class PhysicsMaterial : Object
    {
        internal static readonly PhysicsMaterial Default = new PhysicsMaterial("Default");

        public PhysicsMaterial() { }
        public PhysicsMaterial(string name) => NameImpl = name;

        public float bounciness { get; set; }
        public float dynamicFriction { get; set; } = 0.6f;
        public float staticFriction { get; set; } = 0.6f;
        public PhysicsMaterialCombine frictionCombine { get; set; }
        public PhysicsMaterialCombine bounceCombine { get; set; }

        internal static float CombinedFriction(PhysicsMaterial a, PhysicsMaterial b) =>
            Combine(a.dynamicFriction, b.dynamicFriction, a.frictionCombine, b.frictionCombine);

        internal static float CombinedBounciness(PhysicsMaterial a, PhysicsMaterial b) =>
            Combine(a.bounciness, b.bounciness, a.bounceCombine, b.bounceCombine);

        /// When two materials ask for different modes, the later of average, minimum, multiply, maximum wins.
        static float Combine(float a, float b, PhysicsMaterialCombine modeA, PhysicsMaterialCombine modeB)
        {
            if (modeA == PhysicsMaterialCombine.Maximum || modeB == PhysicsMaterialCombine.Maximum) return Mathf.Max(a, b);
            if (modeA == PhysicsMaterialCombine.Multiply || modeB == PhysicsMaterialCombine.Multiply) return a * b;
            if (modeA == PhysicsMaterialCombine.Minimum || modeB == PhysicsMaterialCombine.Minimum) return Mathf.Min(a, b);
            return (a + b) * 0.5f;
        }
    }
}
