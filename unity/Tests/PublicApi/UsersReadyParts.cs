using System;
using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity.PublicApi.Tests
{
    // User code for the ready-made components, with one line for each component.

    internal sealed class UsersPosition : PositionSensor<float>
    {
        protected override void Write(ref float data, Vector3 position) => data = position.x;
    }

    internal sealed class UsersVelocity : VelocitySensor<float>
    {
        protected override void Write(ref float data, Vector3 velocity) => data = velocity.magnitude;
    }

    internal sealed class UsersBody : RigidbodySensor<float>
    {
        protected override void Write(ref float data, Rigidbody body) => data = body.mass;
    }

    internal sealed class UsersObstacles : ObstacleSensor<float>
    {
        protected override void Write(ref float data, Span<Obstacle> obstacles) => data = obstacles.Length == 0 ? Reach : obstacles[0].Distance;
    }

    internal sealed class UsersRays : RayFanSensor<float>
    {
        protected override void Write(ref float data, Span<RayHit> hits)
        {
            foreach (var hit in hits) data += hit.Collider == null ? Range : hit.Distance;
        }
    }

    internal sealed class UsersContacts : ContactSensor<float>
    {
        protected override void Write(ref float data, Span<Contact> contacts)
        {
            foreach (var contact in contacts) data += contact.Body == null ? 0 : Vector3.Dot(contact.Impulse, contact.Normal) + contact.Point.y;
        }
    }

    internal sealed class UsersZones : ZoneSensor<float>
    {
        protected override void Write(ref float data, Span<Zone> zones)
        {
            foreach (var zone in zones) data += zone.Entered ? 1 : zone.Left ? -1 : 0;
        }
    }

    internal sealed class UsersIntensity : IntensitySensor<float>
    {
        protected override void Write(ref float data, float intensity) => data = intensity;
    }

    internal sealed class UsersSource : IntensitySource
    {
        public override float IntensityAt(Vector3 point) => Peak / (1 + (point - transform.position).sqrMagnitude);
    }

    internal sealed class UsersMove : MoveActuator<float>
    {
        protected override Vector3 Read(float data) => data * Vector3.right;
    }

    internal sealed class UsersForce : AddForceActuator<float>
    {
        protected override Vector3 Read(float data) => data * Vector3.up;
    }

    internal sealed class UsersFlight : SetVelocityActuator<float>
    {
        protected override Vector3 Read(float data) => data * Vector3.forward;
    }

    internal sealed class UsersColour : ColourActuator<float>
    {
        protected override Color Read(float data) => Color.Lerp(Color.black, Color.white, data);
    }

    internal sealed class UsersLamp : EnableActuator<float>
    {
        protected override bool Read(float data) => data > 0;
    }

    internal sealed class UsersView : FieldView<float>
    {
        protected override float Read(float data) => data;
    }

    internal sealed class UsersRule : NeighbourhoodRule
    {
        protected override void FindNeighbours(NeighbourCollector neighbours)
        {
            foreach (var near in neighbours.FindNearest(4))
            {
                var answered = neighbours.NodeOf(near).TryGetAnswer(out float answer);
                neighbours.Add(near, answered ? answer : 0);
            }
        }
    }
}
