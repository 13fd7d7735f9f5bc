using Collektive.Unity;
using NUnit.Framework;
using org.collektive.schema;
using UnityEngine;
using Color = UnityEngine.Color;
using Quaternion = UnityEngine.Quaternion;
using Vector2 = UnityEngine.Vector2;
using Vector3 = UnityEngine.Vector3;

namespace Collektive.Headless.Tests.Components
{
    /// <summary>Tests that values of Unity and of schemas can be assigned to each other without explicit conversions.</summary>
    public sealed class ConversionTests
    {
        [Test]
        public void Values_convert_implicitly_in_both_directions()
        {
            Vector3Value vector = new Vector3(1, 2, 3);
            Vector2Value plane = new Vector2(4, 5);
            QuaternionValue rotation = new Quaternion(0, 1, 0, 0);
            ColorValue colour = new Color(0.1f, 0.2f, 0.3f, 0.4f);
            Assert.That((vector.X, vector.Y, vector.Z, plane.X, plane.Y), Is.EqualTo((1f, 2f, 3f, 4f, 5f)));
            Assert.That((rotation.Y, colour.R, colour.A), Is.EqualTo((1f, 0.1f, 0.4f)));
            Vector3 back = vector;
            Vector2 planeBack = plane;
            Quaternion rotationBack = rotation;
            Color colourBack = colour;
            Assert.That((back, planeBack), Is.EqualTo((new Vector3(1, 2, 3), new Vector2(4, 5))));
            Assert.That((rotationBack, colourBack), Is.EqualTo((new Quaternion(0, 1, 0, 0), new Color(0.1f, 0.2f, 0.3f, 0.4f))));
            Assert.That(Vector3.up + vector, Is.EqualTo(new Vector3(1, 3, 3)));
        }

        [Test]
        public void A_field_of_a_table_takes_Unitys_value_and_a_missing_one_becomes_zero()
        {
            var data = new test.features.SensorData { Position = Vector3.up };
            data.Points.Add(Vector3.right);
            Assert.That((data.Position.Value.Y, data.Points[0].X), Is.EqualTo((1f, 1f)));
            Assert.That(((org.collektive.schema.Vector3?)null).ToUnity(), Is.EqualTo(Vector3.zero));
        }
    }
}
