using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    /// A fixture with physics in script mode. `Run(seconds)` simulates in steps of 0.02 s.
    public abstract class PhysicsFixture : PlayerFixture
    {
        protected const float Step = 0.02f;

        [SetUp]
        public void UseScriptMode() => Physics.simulationMode = SimulationMode.Script;

        protected static void Run(float seconds)
        {
            for (var step = 0; step < Mathf.RoundToInt(seconds / Step); step++) Physics.Simulate(Step);
        }

        protected static Rigidbody Ball(Vector3 place, float radius = 0.5f, PhysicsMaterial material = null)
        {
            var ball = new GameObject("ball");
            ball.transform.position = place;
            var collider = ball.AddComponent<SphereCollider>();
            collider.radius = radius;
            collider.sharedMaterial = material;
            return ball.AddComponent<Rigidbody>();
        }

        protected static BoxCollider Box(Vector3 place, Vector3 size, PhysicsMaterial material = null)
        {
            var box = new GameObject("box");
            box.transform.position = place;
            var collider = box.AddComponent<BoxCollider>();
            collider.size = size;
            collider.sharedMaterial = material;
            return collider;
        }

        protected static BoxCollider Floor(PhysicsMaterial material = null) => Box(new Vector3(0f, -0.5f, 0f), new Vector3(100f, 1f, 60f), material);

        protected static PhysicsMaterial Frictionless() => new PhysicsMaterial
        {
            dynamicFriction = 0f, staticFriction = 0f, frictionCombine = PhysicsMaterialCombine.Minimum,
        };
    }
}
